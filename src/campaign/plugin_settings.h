// Plugins that a command line or a program gives, as settings of a scenario.
#pragma once

#include <string>
#include <vector>

namespace rockyard::campaign {

struct GivenPlugins {
  std::vector<std::string> libraries = {};  // files, relative to the current folder
  std::vector<std::string> processes = {};  // commands, which run in the current folder
};

// Returns "PATH=VALUE" settings: the navigator, the first of the list; the estimator and the
// reader of images, that of the first library which holds one and nothing else; and then the list
// of plugins, in place of that of the scenario. Opens them to know their names. Must stay: what is
// chosen for want of better stands before the list, by which sweeps know it
// (scenario::SweepChanges). Throws core::UserError.
std::vector<std::string> SettingsOf(const GivenPlugins& given);

}  // namespace rockyard::campaign
