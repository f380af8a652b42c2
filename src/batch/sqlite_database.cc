#include "batch/sqlite_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <system_error>

#include "batch/store_error.h"

namespace rockyard::batch {
namespace {

// How long a commit waits for somebody who reads or writes the file with another tool.
constexpr int kBusyTimeoutMs = 2000;

StoreProblem Kind(int code) {
  switch (code & 0xff) {
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
    case StoreProblem::kUnwritable:
      return "cannot be opened or written";
    default:
      return "is damaged or no result store";
  }
}

const char* Suggestion(StoreProblem problem) {
  switch (problem) {
    case StoreProblem::kFull:
      return "free some space on the disk (or lift the quota), then go on with --resume";
    case StoreProblem::kInUse:
      return "wait for the other program or end it, then go on with --resume";
    case StoreProblem::kUnwritable:
      return "check the permissions, or choose another folder with --out";
    default:
      return "run again with --force: the file is set aside, not deleted, and the trials are run "
             "anew";
  }
}

[[noreturn]] void Fail(sqlite3* database, int code, const std::filesystem::path& path) {
  const int extended = database == nullptr ? code : sqlite3_extended_errcode(database);
  const char* text = database == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(database);
  const StoreProblem problem = Kind((extended & 0xff) == (code & 0xff) ? extended : code);
  throw StoreError(problem, path.string(),
                   fmt::format("{} (SQLite {}: {})", Reason(problem), extended, text),
                   Suggestion(problem));
}

int Flags(Access access) {
  switch (access) {
    case Access::kCreate:
      return SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
    case Access::kChange:
      return SQLITE_OPEN_READWRITE;
    case Access::kRead:
      break;
  }
  return SQLITE_OPEN_READONLY;
}

// Percent-encodes what has a meaning in the URI of a file.
std::string FileUri(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char c : path.string()) {
    if (c == '?' || c == '#' || c == '%') {
      uri += fmt::format("%{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      uri += c;
    }
  }
  return uri;
}

// A connection that can read the file, or an error code.
int OpenConnection(const std::string& uri, int flags, sqlite3** database) {
  // A connection is never used by two threads at once: without the mutex a value costs half.
  const int code = sqlite3_open_v2(uri.c_str(), database,
                                   flags | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
  if (code != SQLITE_OK) return code;
  sqlite3_extended_result_codes(*database, 1);
  sqlite3_busy_timeout(*database, kBusyTimeoutMs);
  return sqlite3_exec(*database, "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr);
}

// Commits that are not yet in the main file.
bool HasLog(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path.string() + "-wal", error);
  return !error && size > 0;
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

SqliteDatabase::SqliteDatabase(const std::filesystem::path& path, Access access) : path_(path) {
  const std::string uri = FileUri(path);
  sqlite3* database = nullptr;
  int code = OpenConnection(uri, Flags(access), &database);
  database_.reset(database);
  if (access == Access::kRead && (code & 0xff) == SQLITE_CANTOPEN && !HasLog(path)) {
    // A folder that cannot be written has no place for the shared memory of the write-ahead log. No
    // run can be active there, so that the file may be read as it lies.
    database = nullptr;
    code = OpenConnection(uri + "?immutable=1", Flags(access), &database);
    database_.reset(database);
  }
  if (code != SQLITE_OK) Fail(database_.get(), code, path_);
}

void SqliteDatabase::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

void SqliteDatabase::Execute(const std::string& sql) {
  const int code = sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) Fail(database_.get(), code, path_);
}

SqliteStatement SqliteDatabase::Prepare(std::string_view sql) const {
  return SqliteStatement(database_.get(), path_, sql);
}

std::int64_t SqliteDatabase::Changes() const { return sqlite3_changes64(database_.get()); }

std::optional<std::string> SqliteDatabase::Damage() const {
  return Complaint("PRAGMA quick_check(1)");
}

std::optional<std::string> SqliteDatabase::Damage(std::string_view table) const {
  return Complaint(fmt::format("PRAGMA integrity_check({})", table));
}

std::optional<std::string> SqliteDatabase::Complaint(std::string_view pragma) const {
  SqliteStatement check = Prepare(pragma);
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

}  // namespace rockyard::batch
