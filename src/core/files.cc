#include "core/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"

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
  // std::fopen tells a reason where it fails, a stream does not.
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

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".tmp-";
constexpr std::size_t kDigits = 16;
// What SQLite puts beside a file that it writes.
constexpr std::array<std::string_view, 3> kBeside = {"-journal", "-wal", "-shm"};

// Names are random, so that a taken one is hardly ever met. But each process that looks for
// leftovers may remove what is not locked yet, and a job array has hundreds of processes.
constexpr int kAttempts = 100;

[[noreturn]] void Throw(int reason, const fs::path& path) {
  throw std::system_error(reason, std::generic_category(), path.string());
}

fs::path RandomName(const fs::path& target) {
  std::uint64_t number = 0;
  if (getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number)) {
    Throw(errno, target);
  }
  return fmt::format("{}{}{:016x}", target.string(), kMark, number);
}

// Returns whether this process has the lock and the name still leads to what it locked: a process
// that looks for leftovers may have been faster.
bool LockNew(int descriptor, const fs::path& path) {
  // File systems without locks give none; nothing is taken for a leftover there
  // (RemoveUnlessLocked).
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat own {};
  struct stat named {};
  return fstat(descriptor, &own) == 0 && lstat(path.c_str(), &named) == 0 &&
         own.st_ino == named.st_ino && own.st_dev == named.st_dev;
}

struct Made {
  fs::path path;
  int descriptor = -1;
};

// `make` returns a descriptor, or -1 with errno.
template <typename Make>
Made MakeNew(const fs::path& target, Make make) {
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    fs::path path = RandomName(target);
    const int descriptor = make(path);
    if (descriptor < 0 && errno != EEXIST) Throw(errno, path);
    if (descriptor < 0) continue;
    if (LockNew(descriptor, path)) return {std::move(path), descriptor};
    close(descriptor);
  }
  Throw(EEXIST, target);
}

int OpenFolder(const fs::path& path) {
  return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

int MakeFile(const fs::path& path) {
  constexpr mode_t kReadable = 0644;
  return open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kReadable);
}

// Renames without replacing anything.
int RenameNew(const fs::path& from, const fs::path& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // A file system that knows no such renaming.
  std::error_code error;
  if (fs::exists(fs::symlink_status(to, error))) return EEXIST;
  return rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

bool IsHex(std::string_view text) {
  return text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

void RemoveUnlessLocked(const fs::path& path) {
  std::error_code ignored;
  const fs::file_type type = fs::symlink_status(path, ignored).type();
  if (type != fs::file_type::regular && type != fs::file_type::directory) return;
  const int descriptor = type == fs::file_type::directory
                             ? OpenFolder(path)
                             : open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(path, ignored);
  close(descriptor);
}

}  // namespace

TemporaryFile::TemporaryFile(fs::path target) : target_(std::move(target)) {
  Made made = MakeNew(target_, MakeFile);
  path_ = std::move(made.path);
  descriptor_ = made.descriptor;
}

TemporaryFile::~TemporaryFile() {
  if (!committed_) {
    unlink(path_.c_str());
    for (const std::string_view suffix : kBeside) {
      unlink(fmt::format("{}{}", path_.string(), suffix).c_str());
    }
  }
  Close();
}

void TemporaryFile::Close() {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
}

void TemporaryFile::Sync() {
  if (descriptor_ >= 0 && !synced_ && fsync(descriptor_) != 0) Throw(errno, path_);
  synced_ = true;
}

void TemporaryFile::Commit() {
  Sync();
  if (rename(path_.c_str(), target_.c_str()) != 0) Throw(errno, target_);
  committed_ = true;
  Close();
}

TemporaryFolder::TemporaryFolder(fs::path target, mode_t permissions) : target_(std::move(target)) {
  Made made = MakeNew(target_, [permissions](const fs::path& path) {
    if (mkdir(path.c_str(), permissions) != 0) return -1;
    const int descriptor = OpenFolder(path);
    // Somebody took it for a leftover before it could be locked: another name is as good.
    if (descriptor < 0 && errno == ENOENT) errno = EEXIST;
    return descriptor;
  });
  path_ = std::move(made.path);
  descriptor_ = made.descriptor;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!committed_) fs::remove_all(path_, ignored);
  close(descriptor_);
}

void TemporaryFolder::Commit() {
  if (const int reason = RenameNew(path_, target_); reason != 0) Throw(reason, target_);
  committed_ = true;
}

bool HasRoomForTemporary(const fs::path& target) {
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const long most = pathconf(folder.c_str(), _PC_NAME_MAX);  // -1: no limit, or none known
  const std::size_t bytes = target.filename().string().size() + kMark.size() + kDigits;
  return most < 0 || bytes <= static_cast<std::size_t>(most);
}

bool IsTemporaryOf(const fs::path& target, const fs::path& name) {
  const std::string text = name.filename().string();
  const std::string start = target.filename().string() + std::string(kMark);
  if (!text.starts_with(start)) return false;
  const std::string_view rest = std::string_view(text).substr(start.size());
  if (rest.size() < kDigits || !IsHex(rest.substr(0, kDigits))) return false;
  const std::string_view suffix = rest.substr(kDigits);
  return suffix.empty() || std::find(kBeside.begin(), kBeside.end(), suffix) != kBeside.end();
}

void RemoveLeftovers(const fs::path& target) {
  std::error_code ignored;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    if (IsTemporaryOf(target, entry->path())) found.push_back(entry->path());
  }
  for (const fs::path& path : found) RemoveUnlessLocked(path);
}

}  // namespace rockyard::core
