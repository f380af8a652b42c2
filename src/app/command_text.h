// A command line as it can be typed again.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace rockyard::app {

// "rockyard run scenarios/a.json --trials 10": a subcommand that has been parsed, with what it was
// given, quoted for a POSIX shell where needed. Options that were left out are left out.
std::string CommandText(const CLI::App& command);

// The same for going on with a campaign that stopped: with --resume, and without --force, which
// would set it aside.
std::string ResumeText(const CLI::App& command);

}  // namespace rockyard::app
