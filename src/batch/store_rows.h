// Rows of a store with their checksums, and what is known of each table as a whole. store_tables.cc
// reads and writes the small tables by it, store_trials.cc takes its checksums and tallies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "batch/sqlite_database.h"

namespace rockyard::batch {

class SqliteStatement;

// A checksum of the values of one row of a store: CRC-32 (zlib) over the values in order, each one
// with its type: a letter, then eight little-endian bytes of a number, or the length and the bytes
// of a text. Numbers count by their bits; NaN counts as the NULL that SQLite makes of it. Must
// stay: this form of bytes. Every row of a store has its checksum stored, and by another form all
// of them would be damaged.
//
// It finds accidents: an accident that changes a row goes unseen with probability 2^-32. It does
// not protect against anyone who changes the checksum as well.
class RowChecksum {
 public:
  // Begins with the checksum of what came before, or with that of nothing.
  explicit RowChecksum(std::int64_t before = 0) { Restart(before); }
  void Restart(std::int64_t before = 0);

  RowChecksum& Null();
  RowChecksum& Integer(std::int64_t value);
  RowChecksum& Real(double value);
  RowChecksum& Text(std::string_view value);
  // Adds what stands in the first columns of a row that has been read.
  RowChecksum& Columns(const SqliteStatement& row, int columns);

  // The checksum of all that came so far, 0 .. 2^32-1. More may follow.
  std::int64_t value();

 private:
  void Number(char type, std::uint64_t bits);

  std::uint32_t sum_ = 0;
  std::string bytes_;  // not yet in the sum
};

// A table as it is read and written: its columns but for row_checksum.
struct TableShape {
  std::string_view name;
  std::string_view columns;  // as SQL lists them
  int count = 0;
};

// The table of trials, which store_trials.cc reads and writes without a TableShape.
inline constexpr std::string_view kTrialsTable = "trials";

// What the table `inventory` says of all rows of a table together. The sum of the checksums does
// not depend on the order of the rows, and is taken modulo 2^64, so that whoever adds or changes a
// row needs none of the others.
struct TableTally {
  std::int64_t rows = 0;
  std::uint64_t checksums = 0;

  void Add(std::int64_t checksum);
  void Remove(std::int64_t checksum);
  bool operator==(const TableTally&) const = default;
};

void CreateInventory(SqliteDatabase& database);
// Returns what the inventory says of a table. Throws kDamaged where the inventory lacks the table
// or is damaged itself.
TableTally InventoryOf(const SqliteDatabase& database, std::string_view table);
// Stores the tally. Call it in the transaction that changes the rows.
void SetInventory(SqliteDatabase& database, std::string_view table, const TableTally& tally);

// Throws kDamaged unless the rows that were read are those that were written.
void CheckInventory(const SqliteDatabase& database, std::string_view table,
                    const TableTally& found);

// Reads every row of a small table and checks it. Use it in a SqliteSnapshot, where a run may write
// meanwhile.
class CheckedRows {
 public:
  CheckedRows(const SqliteDatabase& database, const TableShape& table, std::string_view order);

  // Returns whether there is a row to read. Throws kDamaged at a row that does not fit its
  // checksum, and at the end where rows are missing or foreign, or where an index does not find
  // them.
  bool Step();
  const SqliteStatement& row() const { return select_; }

 private:
  const SqliteDatabase& database_;
  TableShape table_;
  SqliteStatement select_;
  RowChecksum checksum_;
  TableTally found_;
};

enum class OnConflict { kFail, kKeepFirst };

// Adds rows to a table, in a transaction of the caller. Add the values of a row in the order of the
// columns, then Write; after the last row call Finish, which stores the tally of the table.
class RowInsert {
 public:
  RowInsert(SqliteDatabase& database, const TableShape& table,
            OnConflict on_conflict = OnConflict::kFail);

  RowInsert& Add(std::int64_t value);
  RowInsert& Add(std::string_view value);
  void Write();
  void Finish();

 private:
  SqliteDatabase& database_;
  TableShape table_;
  SqliteStatement insert_;
  RowChecksum checksum_;
  TableTally tally_;
  bool added_ = false;
  int next_ = 0;
};

// Brings the checksum of the row with that rowid, and the tally of its table, up to date after a
// change. Call it in the transaction that changed the row.
void SealRow(SqliteDatabase& database, const TableShape& table, std::int64_t rowid);

}  // namespace rockyard::batch
