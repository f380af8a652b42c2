#include "batch/sqlite_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include "core/error.h"
#include "core/files.h"

namespace rockyard::batch {
namespace {

// What a code of SQLite means. A read that fails is a damaged file. Every other failure of input
// and output is taken for a disk without room: then the machine failed (IsOfTheMachine), and the
// same command may succeed later.
StoreProblem Kind(int code, int reason) {
  if (code == SQLITE_IOERR_NOMEM) return StoreProblem::kMemory;
  switch (code & 0xff) {
    case SQLITE_NOMEM:
      return StoreProblem::kMemory;
    case SQLITE_FULL:
      return StoreProblem::kFull;
    case SQLITE_IOERR:
      return code == SQLITE_IOERR_READ || code == SQLITE_IOERR_SHORT_READ ? StoreProblem::kDamaged
                                                                          : StoreProblem::kFull;
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return StoreProblem::kInUse;
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
      return ProblemOf(reason);
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return StoreProblem::kUnwritable;
    default:
      return StoreProblem::kDamaged;
  }
}

const char* Reason(StoreProblem problem) {
  switch (problem) {
    case StoreProblem::kFull:
      return "cannot be written";
    case StoreProblem::kInUse:
      return "is locked by another program";
    case StoreProblem::kOpenFiles:
      return "cannot be opened: too many files are open";
    case StoreProblem::kMemory:
      return "cannot be used for want of memory";
    case StoreProblem::kUnwritable:
      return "cannot be opened or written";
    default:
      return "is damaged or no result store";
  }
}

const char* Suggestion(StoreProblem problem) {
  switch (problem) {
    case StoreProblem::kFull:
      return "free some space on the disk (or lift the quota), then repeat the command (run and "
             "sweep with --resume)";
    case StoreProblem::kInUse:
      return "wait for the other program or end it, then repeat the command (run and sweep with "
             "--resume)";
    case StoreProblem::kOpenFiles:
      return core::kMoreOpenFiles;
    case StoreProblem::kMemory:
      return "end other programs or allow more memory (ulimit -v), then repeat the command (run "
             "and sweep with --resume)";
    case StoreProblem::kUnwritable:
      return "check the name and the permissions of the folder, or use another one";
    default:
      return "run it anew, by `rockyard run` or `rockyard sweep` with --force: the file is set "
             "aside, "
             "not deleted";
  }
}

// Returns the errno for which a file was not opened. Where SQLite cannot make a file, it tries to
// read one of that name, and then knows only that there is none, or that it may not write: the
// folder tells why.
int WhyNotOpened(const std::filesystem::path& path, int code, int reason) {
  const bool is_known = (code & 0xff) == SQLITE_CANTOPEN && reason != ENOENT;
  if (is_known || ((code & 0xff) != SQLITE_CANTOPEN && (code & 0xff) != SQLITE_READONLY)) {
    return reason;
  }
  try {
    const core::TemporaryFile probe(path);
    return reason;
  } catch (const std::system_error& error) {
    return error.code().value();
  }
}

[[noreturn]] void Fail(sqlite3* database, int code, const std::filesystem::path& path) {
  const int extended = database == nullptr ? code : sqlite3_extended_errcode(database);
  const char* text = database == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(database);
  const int reason =
      WhyNotOpened(path, code, database == nullptr ? 0 : sqlite3_system_errno(database));
  const StoreProblem problem = Kind((extended & 0xff) == (code & 0xff) ? extended : code, reason);
  throw StoreError(problem, path.string(),
                   fmt::format("{} (SQLite {}: {})", Reason(problem), extended, text),
                   Suggestion(problem));
}

OpenedSqlite OpenFor(Access access, const std::filesystem::path& path) {
  switch (access) {
    case Access::kCreate:
      return OpenSqlite(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    case Access::kChange:
      return OpenSqlite(path, SQLITE_OPEN_READWRITE);
    case Access::kRead:
      break;
  }
  return OpenToRead(path);
}

// Brings the log into the file: a store that ends cleanly is one file, which anybody may read
// anywhere. While somebody reads it, or where the disk has no room, its log stays: that costs no
// trial, and readers know logs.
void FoldLog(sqlite3* database) {
  constexpr int kAttempts = 20;
  constexpr std::chrono::milliseconds kPause{50};
  int code = SQLITE_BUSY;
  for (int attempt = 0; attempt < kAttempts && (code & 0xff) == SQLITE_BUSY; ++attempt) {
    if (attempt > 0) std::this_thread::sleep_for(kPause);
    code = sqlite3_exec(database, "PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode=DELETE",
                        nullptr, nullptr, nullptr);
  }
}

}  // namespace

SqliteStatement::SqliteStatement(sqlite3* database, const std::filesystem::path& path,
                                 std::string_view sql)
    : database_(database), path_(path) {
  sqlite3_stmt* statement = nullptr;
  const int code =
      sqlite3_prepare_v2(database_, sql.data(), static_cast<int>(sql.size()), &statement, nullptr);
  statement_.reset(statement);
  if (code != SQLITE_OK) Fail(database_, code, path_);
}

void SqliteStatement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

SqliteStatement& SqliteStatement::Bind(int parameter, std::int64_t value) {
  const int code = sqlite3_bind_int64(statement_.get(), parameter + 1, value);
  if (code != SQLITE_OK) Fail(database_, code, path_);
  return *this;
}

SqliteStatement& SqliteStatement::Bind(int parameter, double value) {
  const int code = sqlite3_bind_double(statement_.get(), parameter + 1, value);
  if (code != SQLITE_OK) Fail(database_, code, path_);
  return *this;
}

SqliteStatement& SqliteStatement::Bind(int parameter, std::string_view value) {
  const int code = sqlite3_bind_text64(statement_.get(), parameter + 1, value.data(), value.size(),
                                       SQLITE_TRANSIENT, SQLITE_UTF8);
  if (code != SQLITE_OK) Fail(database_, code, path_);
  return *this;
}

SqliteStatement& SqliteStatement::BindNull(int parameter) {
  const int code = sqlite3_bind_null(statement_.get(), parameter + 1);
  if (code != SQLITE_OK) Fail(database_, code, path_);
  return *this;
}

bool SqliteStatement::Step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  Fail(database_, code, path_);
}

void SqliteStatement::Reset() { sqlite3_reset(statement_.get()); }

ValueType SqliteStatement::Type(int column) const {
  switch (sqlite3_column_type(statement_.get(), column)) {
    case SQLITE_NULL:
      return ValueType::kNull;
    case SQLITE_INTEGER:
      return ValueType::kInteger;
    case SQLITE_FLOAT:
      return ValueType::kReal;
    default:
      return ValueType::kText;
  }
}

std::int64_t SqliteStatement::Integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double SqliteStatement::Real(int column) const {
  return sqlite3_column_double(statement_.get(), column);
}

std::string SqliteStatement::Text(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
}

SqliteDatabase::SqliteDatabase(const std::filesystem::path& path, Access access)
    : SqliteDatabase(path, access, path) {}

SqliteDatabase::SqliteDatabase(const std::filesystem::path& path, Access access,
                               std::filesystem::path told)
    : path_(std::move(told)), access_(access) {
  OpenedSqlite opened = OpenFor(access, path);
  database_ = std::move(opened.database);
  if (opened.code != SQLITE_OK) Fail(database_.get(), opened.code, path_);
}

SqliteDatabase::~SqliteDatabase() {
  if (access_ != Access::kRead) FoldLog(database_.get());
}

void SqliteDatabase::Execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) Fail(database_.get(), code, path_);
}

SqliteStatement SqliteDatabase::Prepare(std::string_view sql) const {
  return SqliteStatement(database_.get(), path_, sql);
}

std::int64_t SqliteDatabase::Changes() const { return sqlite3_changes64(database_.get()); }

std::optional<std::string> SqliteDatabase::Damage() const {
  SqliteStatement check = Prepare("PRAGMA integrity_check(1)");
  if (!check.Step()) return "its own check gave no answer";
  const std::string answer = check.Text(0);
  return answer == "ok" ? std::nullopt : std::optional(answer);
}

SqliteTransaction::SqliteTransaction(SqliteDatabase& database) : database_(database) {
  database_.Execute("BEGIN IMMEDIATE");
}

SqliteTransaction::~SqliteTransaction() {
  if (!open_) return;
  try {
    database_.Execute("ROLLBACK");
  } catch (const StoreError&) {
    // SQLite has rolled back by itself after a failed write; the failure is reported by the caller.
  }
}

void SqliteTransaction::Commit() {
  database_.Execute("COMMIT");
  open_ = false;
}

SqliteSnapshot::SqliteSnapshot(const SqliteDatabase& database) : database_(database) {
  database_.Prepare("BEGIN").Step();
}

SqliteSnapshot::~SqliteSnapshot() {
  try {
    database_.Prepare("COMMIT").Step();
  } catch (const StoreError&) {
    // Nothing was written: there is nothing to lose.
  }
}

namespace {

const char* Remedy(StoreProblem problem) {
  switch (problem) {
    case StoreProblem::kFull:
      return "free some space on the disk (or lift the quota), or use another folder";
    case StoreProblem::kOpenFiles:
      return core::kMoreOpenFiles;
    default:
      return "check the name and the permissions of the folder, or use another one";
  }
}

}  // namespace

StoreError::StoreError(StoreProblem problem, std::vector<core::Problem> problems)
    : core::UserError(std::move(problems)), problem_(problem) {}

StoreError::StoreError(StoreProblem problem, std::string path, std::string reason,
                       std::string suggestion)
    : core::UserError(std::move(path), std::move(reason), std::move(suggestion)),
      problem_(problem) {}

bool IsOfTheMachine(StoreProblem problem) {
  return problem == StoreProblem::kFull || problem == StoreProblem::kOpenFiles ||
         problem == StoreProblem::kMemory;
}

StoreProblem ProblemOf(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return StoreProblem::kFull;
    case EMFILE:
    case ENFILE:
      return StoreProblem::kOpenFiles;
    default:
      return StoreProblem::kUnwritable;
  }
}

void FailSystem(const std::filesystem::path& path, std::string_view what, int reason) {
  const StoreProblem problem = ProblemOf(reason);
  throw StoreError(problem, path.string(), fmt::format("{}: {}", what, std::strerror(reason)),
                   Remedy(problem));
}

void FailDamaged(const std::filesystem::path& path, const std::string& reason) {
  throw StoreError(
      StoreProblem::kDamaged, path.string(), reason,
      "run it anew, by `rockyard run` or `rockyard sweep` with --force: the file is set aside, "
      "not deleted");
}

}  // namespace rockyard::batch
