// A command line as it can be typed again, and what to type next: the last line of what a campaign
// says on a terminal.
#pragma once

#include <filesystem>
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

// What a folder holds once its trials have been run: all of a campaign, or one machine's share.
enum class Finished { kWhole, kShard };

// One command that shows more of the folder: its page for a browser, or how shares become one.
std::string NextCommand(const std::filesystem::path& folder, Finished what);

// "  next: COMMAND\n": how to go on with a campaign that stopped (`resume`, empty where it did
// not), else NextCommand. Never broken, however long, so that it can be copied.
std::string NextLine(const std::filesystem::path& folder, Finished what, const std::string& resume);

}  // namespace rockyard::app
