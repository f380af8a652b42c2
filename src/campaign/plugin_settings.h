// Plugins that a command line or a program gives, as settings of a scenario.
#pragma once

#include <string>
#include <vector>

namespace rockyard::campaign {

struct GivenPlugins {
  std::vector<std::string> libraries = {};  // files, relative to the current folder
  std::vector<std::string> processes = {};  // commands, which run in the current folder
};

// Returns "PATH=VALUE" settings: the list of plugins, in place of that of the scenario, and the
// navigator, the first of the list. Opens them to know their names. Throws core::UserError.
std::vector<std::string> SettingsOf(const GivenPlugins& given);

}  // namespace rockyard::campaign
