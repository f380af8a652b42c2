// Navigators of a shared library (abi.h). What a library says of itself is asked in a child
// process; it is loaded into this one when the first drive begins. From then on its code is code of
// this process: a crash ends the process, and the supervisor of campaigns finds the trial.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "plugin/foreign_navigator.h"

namespace rockyard::plugin {

// Returns the kinds of navigators of a library. Throws core::UserError: no such file, no shared
// library, no plugin, of another version of the interface, a wrong description.
std::vector<std::shared_ptr<const NavigatorSource>> OpenLibrary(const std::filesystem::path& file);

}  // namespace rockyard::plugin
