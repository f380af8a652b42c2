// How a store is opened to be read, and the connections of SqliteDatabase (declared in
// sqlite_database.h). No record depends on it. Must stay: whoever reads a store leaves no file
// there and needs no right to write.

#include <fcntl.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "batch/sqlite_database.h"
#include "core/error.h"
#include "core/files.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

// How long a commit waits for somebody who reads or writes the file with another tool. BeginLog
// (result_store.cc) waits as long.
constexpr int kBusyTimeoutMs = 2000;

// Returns a URI of the file, with percent-encoded what has a meaning in a URI. An absolute path
// follows an empty authority; else its own "//" would be taken for an authority.
std::string FileUri(const fs::path& path) {
  std::string uri = path.is_absolute() ? "file://" : "file:";
  for (const char c : path.string()) {
    if (c == '?' || c == '#' || c == '%') {
      uri += fmt::format("%{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      uri += c;
    }
  }
  return uri;
}

OpenedSqlite Open(const std::string& uri, int flags) {
  sqlite3* database = nullptr;
  // A connection is never used by two threads at once: without the mutex a value takes half the
  // time.
  const int code = sqlite3_open_v2(uri.c_str(), &database,
                                   flags | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
  SqliteHandle handle(database);
  if (code != SQLITE_OK) return {std::move(handle), code};
  // A store may come from anybody: its schema runs no functions with effects, and no statement
  // changes the schema behind our back.
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_extended_result_codes(database, 1);
  sqlite3_busy_timeout(database, kBusyTimeoutMs);
  return {std::move(handle), SQLITE_OK};
}

OpenedSqlite Try(OpenedSqlite opened) {
  if (opened.code != SQLITE_OK) return opened;
  opened.code = sqlite3_exec(opened.database.get(), "SELECT count(*) FROM sqlite_master", nullptr,
                             nullptr, nullptr);
  return opened;
}

// Opens the bytes of the file as they lie, whatever its logs hold.
OpenedSqlite OpenAsItLies(const fs::path& path) {
  return Open(FileUri(path) + "?immutable=1", SQLITE_OPEN_READONLY);
}

fs::path Beside(const fs::path& path, const char* suffix) { return path.string() + suffix; }

bool HasFile(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// The bytes of a database, read through its connection. They are not read by open and close: the
// close would end the locks that other connections of this process have on the file.
class RawFile {
 public:
  explicit RawFile(sqlite3* database) {
    sqlite3_file_control(database, "main", SQLITE_FCNTL_FILE_POINTER, &file_);
  }

  std::int64_t Size() const {
    sqlite3_int64 size = 0;
    const bool known =
        file_->pMethods != nullptr && file_->pMethods->xFileSize(file_, &size) == SQLITE_OK;
    return known ? size : 0;
  }

  // Returns false where the disk or the file does not give the bytes.
  bool Read(std::int64_t from, std::string& bytes) const {
    return file_->pMethods->xRead(file_, bytes.data(), static_cast<int>(bytes.size()), from) ==
           SQLITE_OK;
  }

 private:
  sqlite3_file* file_ = nullptr;
};

// Returns whether the commits of the store go through a write-ahead log
// (https://www.sqlite.org/fileformat.html, 1.3.3).
bool UsesLog(const fs::path& path) {
  constexpr std::size_t kHeaderBytes = 100;
  constexpr std::size_t kReadVersion = 19;
  constexpr char kWithLog = 2;
  const OpenedSqlite opened = OpenAsItLies(path);
  if (opened.code != SQLITE_OK) return false;
  const RawFile file(opened.database.get());
  std::string header(kHeaderBytes, '\0');
  return file.Size() >= std::ssize(header) && file.Read(0, header) &&
         header[kReadVersion] == kWithLog;
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags)
      : value_(open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int value() const { return value_; }

 private:
  int value_;
};

// Returns at most so many of the first bytes of a file; none where there is no such file.
std::string FirstBytes(const fs::path& path, std::size_t most) {
  const Descriptor file(path, O_RDONLY);
  std::string bytes(most, '\0');
  const ssize_t read = file.value() < 0 ? 0 : pread(file.value(), bytes.data(), bytes.size(), 0);
  bytes.resize(read < 0 ? 0 : static_cast<std::size_t>(read));
  return bytes;
}

// Returns a text that changes whenever the copies of a store and its logs may not belong together.
// The salt in the header of the write-ahead log changes when the log begins anew. Before that, the
// store with all of the log is the last commit, whatever is being brought from the log to the
// store.
std::string LogMark(const fs::path& path) {
  constexpr std::size_t kHeaderBytes = 32;
  std::error_code error;
  const auto journal = fs::file_size(Beside(path, "-journal"), error);
  return fmt::format("{} {} {}", HasFile(Beside(path, "-wal")), error ? 0 : journal,
                     FirstBytes(Beside(path, "-wal"), kHeaderBytes));
}

[[noreturn]] void FailCopy(const fs::path& path, int reason) {
  const StoreProblem problem = ProblemOf(reason);
  throw StoreError(
      problem, path.string(),
      fmt::format("cannot take the copy that a run is read from: {}", std::strerror(reason)),
      problem == StoreProblem::kOpenFiles ? core::kMoreOpenFiles
                                          : "make room or set TMPDIR to a folder that has some");
}

// Makes a folder that only this user can enter. Removes what a reader left that was killed while it
// took its copy.
core::TemporaryFolder PrivateFolder() {
  constexpr mode_t kOwner = 0700;
  std::error_code error;
  const fs::path found = fs::temp_directory_path(error);
  const fs::path parent = error ? fs::path("/tmp") : found;
  const fs::path target = parent / "rockyard-read";
  core::RemoveLeftovers(target);
  try {
    return core::TemporaryFolder(target, kOwner);
  } catch (const std::system_error& failure) {
    FailCopy(parent, failure.code().value());
  }
}

constexpr std::size_t kPiece = std::size_t{1} << 20;

void WriteAll(const Descriptor& to, const fs::path& path, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(to.value(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) FailCopy(path, errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

// Copies the store itself. Returns false where it cannot be read.
bool CopyStore(const RawFile& from, const fs::path& path) {
  const Descriptor to(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (to.value() < 0) FailCopy(path, errno);
  const std::int64_t size = from.Size();
  std::string bytes;
  for (std::int64_t at = 0; at < size; at += std::ssize(bytes)) {
    bytes.resize(std::min(kPiece, static_cast<std::size_t>(size - at)));
    if (!from.Read(at, bytes)) return false;
    WriteAll(to, path, bytes);
  }
  return true;
}

// Copies a log; does nothing where there is none.
void CopyLog(const fs::path& log, const fs::path& path) {
  const Descriptor from(log, O_RDONLY);
  if (from.value() < 0 && errno != ENOENT) FailSystem(log, "cannot be read", errno);
  fs::remove(path);  // of an earlier attempt
  if (from.value() < 0) return;
  const Descriptor to(path, O_WRONLY | O_CREAT | O_TRUNC);
  if (to.value() < 0) FailCopy(path, errno);
  std::string bytes(kPiece, '\0');
  for (;;) {
    const ssize_t read = ::read(from.value(), bytes.data(), bytes.size());
    if (read < 0 && errno == EINTR) continue;
    if (read < 0) FailSystem(log, "cannot be read", errno);
    if (read == 0) return;
    WriteAll(to, path, std::string_view(bytes).substr(0, static_cast<std::size_t>(read)));
  }
}

// Copies the last commit. Returns false where the store itself cannot be read.
bool CopyLastCommit(const fs::path& path, const RawFile& file, const fs::path& copy) {
  constexpr int kAttempts = 50;
  constexpr std::chrono::milliseconds kPause{20};
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const std::string before = LogMark(path);
    if (!CopyStore(file, copy)) return false;
    for (const char* suffix : {"-wal", "-journal"}) {
      CopyLog(Beside(path, suffix), Beside(copy, suffix));
    }
    if (LogMark(path) == before) return true;
    std::this_thread::sleep_for(kPause);
  }
  throw StoreError(StoreProblem::kInUse, path.string(), "changes all the time while it is read",
                   "try again, or read it when its run has ended");
}

// Brings the logs of the copy into it, so that it is one file.
int FoldLogs(const fs::path& copy) {
  OpenedSqlite opened = Try(Open(FileUri(copy), SQLITE_OPEN_READWRITE));
  if (opened.code != SQLITE_OK) return opened.code;
  return sqlite3_exec(opened.database.get(), "PRAGMA journal_mode=DELETE", nullptr, nullptr,
                      nullptr);
}

OpenedSqlite OpenCopy(const fs::path& path) {
  OpenedSqlite original = OpenAsItLies(path);
  if (original.code != SQLITE_OK) return original;
  const core::TemporaryFolder folder = PrivateFolder();
  const fs::path copy = folder.path() / "store";
  if (!CopyLastCommit(path, RawFile(original.database.get()), copy)) {
    return {std::move(original.database), SQLITE_IOERR_READ};
  }
  if (const int code = FoldLogs(copy); code != SQLITE_OK) return {nullptr, code};
  return Try(OpenAsItLies(copy));
}

// Returns whether the code is that of a reader who may not write, or of a disk without room for
// shared memory.
bool NeedsCopy(int code) {
  switch (code & 0xff) {
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_FULL:
    case SQLITE_IOERR:
      return true;
    default:
      return false;
  }
}

}  // namespace

void CloseSqlite::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

OpenedSqlite OpenSqlite(const fs::path& path, int flags) { return Try(Open(FileUri(path), flags)); }

OpenedSqlite OpenToRead(const fs::path& named) {
  // Logs lie beside the file itself, not beside a link to it.
  std::error_code error;
  const fs::path found = fs::canonical(named, error);
  const fs::path& path = error ? named : found;
  if (!HasFile(Beside(path, "-shm")) && UsesLog(path)) return OpenCopy(path);
  OpenedSqlite opened = OpenSqlite(path, SQLITE_OPEN_READONLY);
  if (!NeedsCopy(opened.code)) return opened;
  opened.database.reset();
  return OpenCopy(path);
}

}  // namespace rockyard::batch
