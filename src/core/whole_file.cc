#include "core/whole_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "core/error.h"
#include "core/machine_error.h"
#include "core/utf8.h"

namespace rockyard::core {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

[[noreturn]] void FailToOpen(const fs::path& path, int reason) {
  const std::string what = fmt::format("cannot be read: {}", std::strerror(reason));
  if (reason == EMFILE || reason == ENFILE) throw MachineError(path.string(), what, kMoreOpenFiles);
  throw UserError(path.string(), what, "check its permissions");
}

void CheckRegular(const fs::path& path, std::string_view kind) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (error == std::errc::permission_denied) FailToOpen(path, error.value());
  if (!fs::exists(status)) {
    throw UserError(path.string(), "the file does not exist", "check the name and the folder");
  }
  if (!fs::is_regular_file(status)) {
    throw UserError(
        path.string(),
        fs::is_directory(status) ? "is a folder, not a regular file" : "is not a regular file",
        fmt::format("name {}", kind));
  }
}

}  // namespace

std::string ReadWholeFile(const fs::path& path, std::size_t max_bytes, std::string_view kind) {
  CheckRegular(path, kind);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > max_bytes) {
    throw UserError(path.string(),
                    fmt::format("has {} bytes, more than the {} allowed", size, max_bytes),
                    "check that this is the right file");
  }
  // With a reason where it fails, which a stream does not have.
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rbe"));
  if (!file) FailToOpen(path, errno);
  std::string text(error ? 0 : size, '\0');
  if (std::fread(text.data(), 1, text.size(), file.get()) != text.size()) {
    throw UserError(path.string(), "ends early", "check the disk and the file");
  }
  return text;
}

std::string ReadTextFile(const fs::path& path, std::size_t max_bytes, std::string_view kind) {
  std::string text = ReadWholeFile(path, max_bytes, kind);
  const std::size_t good = std::min(Utf8Bytes(text), text.find('\0'));
  if (good < text.size()) {
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(good), '\n');
    throw UserError(fmt::format("{}: line {}", path.string(), line),
                    fmt::format("byte {:#04x} is no text of UTF-8",
                                static_cast<unsigned>(static_cast<unsigned char>(text[good]))),
                    fmt::format("name {}; if it is of another encoding, save it as UTF-8", kind));
  }
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

}  // namespace rockyard::core
