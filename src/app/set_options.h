// The options by which every command that takes a scenario changes it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rockyard::app {

// Adds --set, and --plugin and --navigator-process, which become settings that stand before those
// of
// --set. `overrides` must outlive the command.
void AddSetOptions(CLI::App& command, std::vector<std::string>& overrides);

}  // namespace rockyard::app
