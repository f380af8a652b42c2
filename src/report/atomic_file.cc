#include "report/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace rockyard::report {
namespace {

// Errno of the first failure, or 0.
int WriteAll(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)),
      temporary_(fmt::format("{}.tmp-{}", path_.string(), getpid())),
      descriptor_(open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {
  if (descriptor_ < 0) Fail(errno);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(temporary_.c_str());
}

void AtomicFile::Write(std::string_view text) {
  constexpr std::size_t kAtOnce = 1 << 20;
  waiting_ += text;
  if (waiting_.size() >= kAtOnce) Flush();
}

void AtomicFile::Flush() {
  if (const int reason = WriteAll(descriptor_, waiting_); reason != 0) Fail(reason);
  waiting_.clear();
}

void AtomicFile::Commit() {
  Flush();
  int reason = fsync(descriptor_) == 0 ? 0 : errno;
  if (close(descriptor_) != 0 && reason == 0) reason = errno;
  descriptor_ = -1;
  if (reason == 0 && rename(temporary_.c_str(), path_.c_str()) != 0) reason = errno;
  if (reason == 0) return;
  unlink(temporary_.c_str());
  Fail(reason);
}

void AtomicFile::Fail(int reason) {
  throw core::UserError(path_.string(), fmt::format("cannot be written: {}", std::strerror(reason)),
                        "check the free space and the permissions of its folder");
}

void WriteFileAtomically(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.Write(text);
  file.Commit();
}

void WriteFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const TextSink&)>& make) {
  AtomicFile file(path);
  make([&](std::string_view text) { file.Write(text); });
  file.Commit();
}

}  // namespace rockyard::report
