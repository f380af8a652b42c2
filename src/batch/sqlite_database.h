// A thin, throwing layer over SQLite: connections, statements, transactions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "batch/sqlite_open.h"

struct sqlite3_stmt;

namespace rockyard::batch {

enum class Access {
  kCreate,  // the file must not exist yet, or be empty
  kChange,  // an existing file
  kRead,    // an existing file, also without a right to write (sqlite_open.h)
};

// How a value lies in a row; bytes that are no text (BLOB) count as one.
enum class ValueType { kNull, kInteger, kReal, kText };

// One prepared statement. Columns and parameters count from 0.
class SqliteStatement {
 public:
  SqliteStatement(sqlite3* database, const std::filesystem::path& path, std::string_view sql);

  SqliteStatement& Bind(int parameter, std::int64_t value);
  SqliteStatement& Bind(int parameter, double value);  // NaN becomes NULL
  SqliteStatement& Bind(int parameter, std::string_view value);
  SqliteStatement& BindNull(int parameter);

  // True while there is a row to read.
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
// The end of one that may write brings the write-ahead log into the file, unless somebody reads it.
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

  // Rows that the last statement which has ended added, changed or deleted.
  std::int64_t Changes() const;

  // The first complaint of SQLite's own check of the file, or nothing. With the indexes, by which
  // rows are found: one that is not found is missing without a sign.
  std::optional<std::string> Damage() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Access access_;
  SqliteHandle database_;
};

// Rolls back unless committed.
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

// As long as it lives, everything read is of one moment, whatever a run adds meanwhile. Not within
// a transaction.
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
