// Files that are there whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace rockyard::report {

// Writes to a temporary file beside `path`, brings it to the disk and renames it. A reader sees the
// old text or the new one; a failure leaves the old file and no temporary one. Throws
// core::UserError: no permission, no space.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view text);

}  // namespace rockyard::report
