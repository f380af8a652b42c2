#include "report/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/files.h"

namespace rockyard::report {
namespace {

// Returns errno of the first failure, or 0.
int WriteAll(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

[[noreturn]] void Fail(const std::filesystem::path& path, const std::error_code& reason) {
  core::FailOnDisk(path, "cannot be written", reason);
}

// What killed processes left is removed first: it may be what fills the disk.
std::unique_ptr<core::TemporaryFile> MakeTemporary(const std::filesystem::path& path) {
  core::RemoveLeftovers(path);
  try {
    return std::make_unique<core::TemporaryFile>(path);
  } catch (const std::system_error& error) {
    Fail(path, error.code());
  }
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), temporary_(MakeTemporary(path_)) {}
AtomicFile::~AtomicFile() = default;

void AtomicFile::Write(std::string_view text) {
  constexpr std::size_t kAtOnce = 1 << 20;
  waiting_ += text;
  if (waiting_.size() >= kAtOnce) Flush();
}

void AtomicFile::Flush() {
  if (const int reason = WriteAll(temporary_->descriptor(), waiting_); reason != 0) {
    Fail(path_, {reason, std::generic_category()});
  }
  waiting_.clear();
}

template <typename Action>
void AtomicFile::OnDisk(const Action& action) {
  Flush();
  try {
    action(*temporary_);
  } catch (const std::system_error& error) {
    Fail(path_, error.code());
  }
}

void AtomicFile::Sync() {
  OnDisk([](core::TemporaryFile& file) { file.Sync(); });
}

void AtomicFile::Commit() {
  OnDisk([](core::TemporaryFile& file) { file.Commit(); });
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
