// Files that a command is asked to write. They are written by report::WriteFileAtomically.
#pragma once

#include <string>
#include <string_view>

namespace rockyard::app {

// Throws core::UserError where `file` cannot be meant: it is a folder, or in a folder that does not
// exist. Called before long work rather than after it; an empty name passes. `option` is the one to
// blame, such as "--out".
void CheckOutputFile(std::string_view option, const std::string& file);

}  // namespace rockyard::app
