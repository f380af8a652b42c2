// A thin, throwing layer over SQLite: connections, statements, transactions; how a store is opened,
// and what can go wrong with it and its folder. The files of the store use the layer; campaigns and
// commands see only its errors.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

struct sqlite3_stmt;

struct sqlite3;

namespace rockyard::batch {

// What can go wrong with a run folder and its store.
enum class StoreProblem {
  kMissing,     // no store where one is needed
  kExists,      // a store where none may be
  kUnwritable,  // the folder or a file in it cannot be made or written
  kFull,        // no space left, or a limit on file sizes or quotas
  kOpenFiles,   // the process or the machine may open no more files
  kMemory,      // the process could get no more memory
  kInUse,       // another process runs in this folder
  kDamaged,     // no database, cut off, or with contents that no version of this program wrote
  kMismatch,    // made by another scenario, seed or build
};

// A failure of a run folder or its store. Every message names the file or folder, what is wrong,
// and what to do.
class StoreError : public core::UserError {
 public:
  StoreError(StoreProblem problem, std::vector<core::Problem> problems);
  StoreError(StoreProblem problem, std::string path, std::string reason, std::string suggestion);

  StoreProblem problem() const { return problem_; }

 private:
  StoreProblem problem_;
};

// Returns whether the machine failed, not the request: then the same command may succeed later, and
// the exit code is 5 in place of 2 (campaign::Guarded).
bool IsOfTheMachine(StoreProblem problem);

// Returns what an errno means for a file or folder that is to be made, opened or written.
StoreProblem ProblemOf(int reason);

// Throws what an errno means, with what to do. `what`: "cannot be made".
[[noreturn]] void FailSystem(const std::filesystem::path& path, std::string_view what, int reason);

// Throws kDamaged, with what to do.
[[noreturn]] void FailDamaged(const std::filesystem::path& path, const std::string& reason);

struct CloseSqlite {
  void operator()(sqlite3* database) const;
};
using SqliteHandle = std::unique_ptr<sqlite3, CloseSqlite>;

// A connection, and SQLite's code of its first statement. Where that statement failed, the
// connection knows why.
struct OpenedSqlite {
  SqliteHandle database;
  int code = 0;
};

// `flags`: SQLITE_OPEN_*.
OpenedSqlite OpenSqlite(const std::filesystem::path& path, int flags);

// Opens a store to read it, in such a way that no file is left beside it and no right to write
// there is needed.
//
// A store that ended cleanly is one file, and is read as it lies. A store that is being written has
// its log and the shared memory of that log, through which SQLite reads the last commit. Every
// other store is read from a private copy: one whose run was killed; one whose shared memory the
// reader may not write, or for which the disk has no room; and one without shared memory, which
// SQLite would make and leave there. The copy is taken with the logs, so that it is the last
// commit. It lies in the folder for temporary files, is gone from there when this returns, and
// takes room until the connection is closed.
//
// Throws StoreError: kFull, kOpenFiles or kUnwritable where the copy cannot be made, kInUse where
// the store changes all the time meanwhile.
OpenedSqlite OpenToRead(const std::filesystem::path& path);

enum class Access {
  kCreate,  // the file must not exist yet, or be empty
  kChange,  // an existing file
  kRead,    // an existing file, also without a right to write
};

// How a value lies in a row. Bytes that are no text (BLOB) count as kText.
enum class ValueType { kNull, kInteger, kReal, kText };

// One prepared statement. Columns and parameters count from 0.
class SqliteStatement {
 public:
  SqliteStatement(sqlite3* database, const std::filesystem::path& path, std::string_view sql);

  SqliteStatement& Bind(int parameter, std::int64_t value);
  SqliteStatement& Bind(int parameter, double value);  // NaN becomes NULL
  SqliteStatement& Bind(int parameter, std::string_view value);
  SqliteStatement& BindNull(int parameter);

  // Returns whether there is a row to read.
  bool Step();
  void Reset();

  ValueType Type(int column) const;
  std::int64_t Integer(int column) const;
  double Real(int column) const;
  std::string Text(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };

  sqlite3* database_;
  std::filesystem::path path_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

// One connection. Every failure is a StoreError that names the file. Not for two threads at once.
// The end of a connection that may write brings the write-ahead log into the file, unless somebody
// reads it.
class SqliteDatabase {
 public:
  SqliteDatabase(const std::filesystem::path& path, Access access);
  // `told`: the name that errors give the file.
  SqliteDatabase(const std::filesystem::path& path, Access access, std::filesystem::path told);
  ~SqliteDatabase();
  SqliteDatabase(const SqliteDatabase&) = delete;
  SqliteDatabase& operator=(const SqliteDatabase&) = delete;

  void Execute(const std::string& sql);
  SqliteStatement Prepare(std::string_view sql) const;

  // Returns how many rows the last statement that has ended added, changed or deleted.
  std::int64_t Changes() const;

  // Returns the first complaint of SQLite's own check of the file, or nothing. The check includes
  // the indexes, by which rows are found: a row that an index lacks would be missing without a
  // sign.
  std::optional<std::string> Damage() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Access access_;
  SqliteHandle database_;
};

// A transaction, which is rolled back unless it is committed.
class SqliteTransaction {
 public:
  explicit SqliteTransaction(SqliteDatabase& database);
  ~SqliteTransaction();
  SqliteTransaction(const SqliteTransaction&) = delete;
  SqliteTransaction& operator=(const SqliteTransaction&) = delete;

  void Commit();

 private:
  SqliteDatabase& database_;
  bool open_ = true;
};

// As long as it lives, everything read is of one moment, whatever a run adds meanwhile. Not to be
// made within a transaction.
class SqliteSnapshot {
 public:
  explicit SqliteSnapshot(const SqliteDatabase& database);
  ~SqliteSnapshot();
  SqliteSnapshot(const SqliteSnapshot&) = delete;
  SqliteSnapshot& operator=(const SqliteSnapshot&) = delete;

 private:
  const SqliteDatabase& database_;
};

}  // namespace rockyard::batch
