// What `rockyard` alone says.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace rockyard::app {

// What the program is, three commands to begin with, where the documentation is, and every
// subcommand of the parser with a line.
std::string StartText(const CLI::App& app);

}  // namespace rockyard::app
