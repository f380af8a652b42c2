// Files that are there whole or not at all. Every command and campaign writes its result files by
// it. No record depends on it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace rockyard::core {
class TemporaryFile;
}  // namespace rockyard::core

namespace rockyard::report {

// A file that is written piece by piece to a temporary one beside `path` (core/files.h),
// brought to the disk and renamed by Commit. A reader sees the old text or the new one; a failure,
// or no Commit, leaves the old file and no temporary one; what a killed process left is removed by
// the next one that writes the same file. The constructor, Write, Sync and Commit throw
// core::UserError (no permission) and core::MachineError (no space).
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void Write(std::string_view text);
  // Brings the text to the disk, so that Commit, which does so too, has only to rename. Once, after
  // the last Write.
  void Sync();
  // Brings the text to the disk and renames the temporary file. Once, after the last Write.
  void Commit();
  const std::filesystem::path& path() const { return path_; }

 private:
  void Flush();
  template <typename Action>
  void OnDisk(const Action& action);

  std::filesystem::path path_;
  std::unique_ptr<core::TemporaryFile> temporary_;
  std::string waiting_;  // to be written, some lines at once
};

// Writes all of a file at once.
void WriteFileAtomically(const std::filesystem::path& path, std::string_view text);

// Where a text goes that is made piece by piece, so that it need not be held as a whole.
using TextSink = std::function<void(std::string_view)>;
void WriteFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const TextSink&)>& make);

}  // namespace rockyard::report
