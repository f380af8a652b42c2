// Files that a command writes on the side.
#pragma once

#include <string>
#include <string_view>

namespace rockyard::app {

// Writes the file as report::WriteFileAtomically does, and says on standard error what is where, so
// that standard output keeps what was asked for: "  table in FILE".
void WriteNamedFile(std::string_view what, const std::string& file, std::string_view bytes);

}  // namespace rockyard::app
