// Files of others, which are read whole; and files and folders of our own, which take their names
// when they are whole. Readers of JSON, images, cameras and paths use the first, stores of results
// and writers of output the others. No record depends on these; the names of temporary files must
// stay, as a later build removes by them what an earlier one has left.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace rockyard::core {

// Returns all bytes of a regular file. `kind` is what the user should have named: "a JSON file".
// Throws UserError: no such file, a folder, a device or a pipe, no permission, more than
// `max_bytes` (before any is read), or an end before its size is read; MachineError where no more
// files may be open.
std::string ReadWholeFile(const std::filesystem::path& path, std::size_t max_bytes,
                          std::string_view kind);

// Returns the same of a file of text: UTF-8, without the byte order mark that editors put before
// it. Throws UserError, too, with the line, for a byte that is no UTF-8 or zero.
std::string ReadTextFile(const std::filesystem::path& path, std::size_t max_bytes,
                         std::string_view kind);

// A new, empty file beside `target`, called <target>.tmp- and sixteen random hexadecimal digits. It
// is made exclusively and follows no link, so that nobody can plant something in its place. While
// it is open it is locked, by which RemoveLeftovers knows that its process lives. Every failure is
// a std::system_error with the errno.
class TemporaryFile {
 public:
  // Readable as the umask says.
  explicit TemporaryFile(std::filesystem::path target);
  // Removes the file, and what a library has put beside it, unless it was committed.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // -1 after Close.
  int descriptor() const { return descriptor_; }

  // Closes the file, for a library that opens it by its name, and releases the lock. Before that
  // the caller must have claimed the folder, or another process may delete the file as the leftover
  // of a dead one.
  void Close();

  // Brings the file to the disk, so that what fails does so before Commit.
  void Sync();

  // Brings the file to the disk, unless Sync has done so or the file is closed (its writer has done
  // so then), and gives it the name of the target. Call it once.
  void Commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  int descriptor_ = -1;  // -1: closed
  bool synced_ = false;
  bool committed_ = false;
};

// The same for a folder, named as the files are.
class TemporaryFolder {
 public:
  // The folder gets `permissions` less those that the umask takes away.
  explicit TemporaryFolder(std::filesystem::path target, mode_t permissions = 0777);
  // Removes the folder and all that is in it, unless it was committed.
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  // Gives the folder the name of the target. Call it once. Throws EEXIST where something has that
  // name by now.
  void Commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  int descriptor_ = -1;
  bool committed_ = false;
};

// Returns whether the file system of its folder allows names that are long enough for a temporary
// file of `target`.
bool HasRoomForTemporary(const std::filesystem::path& target);

// Returns whether a file or folder of that name is a temporary one for `target`, or one that SQLite
// puts beside it.
bool IsTemporaryOf(const std::filesystem::path& target, const std::filesystem::path& name);

// Removes what processes that were killed have left beside `target`: temporary files and folders
// for it that no living process has locked. It removes nothing else, and no link. What cannot be
// removed stays; so does everything on file systems that know no locks. Cost: reads the names in
// the folder.
void RemoveLeftovers(const std::filesystem::path& target);

}  // namespace rockyard::core
