#include "report/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace rockyard::report {
namespace {

[[noreturn]] void Fail(const std::filesystem::path& path, int reason) {
  throw core::UserError(path.string(), fmt::format("cannot be written: {}", std::strerror(reason)),
                        "check the free space and the permissions of its folder");
}

// Errno of the first failure, or 0.
int WriteAll(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

void WriteFileAtomically(const std::filesystem::path& path, std::string_view text) {
  const std::string temporary = fmt::format("{}.tmp-{}", path.string(), getpid());
  const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) Fail(path, errno);
  int reason = WriteAll(descriptor, text);
  if (close(descriptor) != 0 && reason == 0) reason = errno;
  if (reason == 0 && rename(temporary.c_str(), path.c_str()) != 0) reason = errno;
  if (reason == 0) return;
  unlink(temporary.c_str());
  Fail(path, reason);
}

}  // namespace rockyard::report
