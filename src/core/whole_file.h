// Files of others, read whole.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace rockyard::core {

// All bytes of a regular file, none of an empty one. `kind` says what to name instead of something
// else: "a JSON file". Throws UserError: no such file, a folder, a device or a pipe, no permission,
// more than `max_bytes` (before any is read), or an end before its size is read; MachineError where
// no more files may be open.
std::string ReadWholeFile(const std::filesystem::path& path, std::size_t max_bytes,
                          std::string_view kind);

// The same of a file of text: UTF-8, without the byte order mark that editors put before it. Throws
// UserError, too, with the line, for bytes that are none, of which zero is one.
std::string ReadTextFile(const std::filesystem::path& path, std::size_t max_bytes,
                         std::string_view kind);

}  // namespace rockyard::core
