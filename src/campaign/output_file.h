// Files that a command is asked to write. They are written by report::WriteFileAtomically.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rockyard::campaign {

// Throws core::UserError where `file` cannot be meant: it is a folder, a device or a pipe, a file
// of the run that lies in its folder, or in a folder that does not exist or cannot be written to.
// Called before long work rather than after it; an empty name passes. `option` is the one to blame,
// such as "--out".
void CheckOutputFile(std::string_view option, const std::string& file);

// Throws core::UserError where the name of `file` does not end in `extension` (".html"), by which
// other programs know what is in it; an empty name passes.
void CheckExtension(std::string_view option, const std::string& file, std::string_view extension);

struct NamedFile {
  std::string option;
  std::string file;
};

// Throws core::UserError where two of a command's files are the same; empty names are none.
void CheckDistinct(std::span<const NamedFile> files);

}  // namespace rockyard::campaign
