// Rows of a store with their checksums, and what is known of each table as a whole.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "batch/row_checksum.h"
#include "batch/sqlite_database.h"

namespace rockyard::batch {

// Whether a store can tell that it was damaged.
enum class Checksums {
  kNone,     // version 2
  kEachRow,  // version 3: a column row_checksum in every table, and the table `inventory`
};

// A table as it is read and written: its columns but for row_checksum.
struct TableShape {
  std::string_view name;
  std::string_view columns;  // as SQL lists them
  int count = 0;
};

// Its values go by another way (store_trials.cc).
inline constexpr std::string_view kTrialsTable = "trials";

// All rows of a table together; in the table `inventory`. The sum of the checksums does not depend
// on the order of the rows, and is taken modulo 2^64.
struct TableTally {
  std::int64_t rows = 0;
  std::uint64_t checksums = 0;

  void Add(std::int64_t checksum);
  void Remove(std::int64_t checksum);
  bool operator==(const TableTally&) const = default;
};

void CreateInventory(SqliteDatabase& database);
// kDamaged where the inventory lacks the table or is damaged itself.
TableTally InventoryOf(const SqliteDatabase& database, std::string_view table);
// In the transaction that changes the rows.
void SetInventory(SqliteDatabase& database, std::string_view table, const TableTally& tally);

// Throws kDamaged unless the rows that were read are those that were written.
void CheckInventory(const SqliteDatabase& database, std::string_view table,
                    const TableTally& found);

// Reads every row of a small table and checks it. In a SqliteSnapshot, where a run may write.
class CheckedRows {
 public:
  CheckedRows(const SqliteDatabase& database, Checksums checksums, const TableShape& table,
              std::string_view order);

  // True while there is a row to read. Throws kDamaged at a row that does not fit its checksum, and
  // at the end where rows are missing or foreign, or where an index does not find them.
  bool Step();
  const SqliteStatement& row() const { return select_; }

 private:
  const SqliteDatabase& database_;
  Checksums checksums_;
  TableShape table_;
  SqliteStatement select_;
  RowChecksum checksum_;
  TableTally found_;
};

enum class OnConflict { kFail, kKeepFirst };

// Adds rows to a table, in a transaction of the caller: for each row its values in the order of the
// columns, then Write; after the last one Finish.
class RowInsert {
 public:
  RowInsert(SqliteDatabase& database, Checksums checksums, const TableShape& table,
            OnConflict on_conflict = OnConflict::kFail);

  RowInsert& Add(std::int64_t value);
  RowInsert& Add(std::string_view value);
  void Write();
  void Finish();

 private:
  SqliteDatabase& database_;
  Checksums checksums_;
  TableShape table_;
  SqliteStatement insert_;
  RowChecksum checksum_;
  TableTally tally_;
  bool added_ = false;
  int next_ = 0;
};

// After a change of the row with that rowid, in the transaction that changed it.
void SealRow(SqliteDatabase& database, Checksums checksums, const TableShape& table,
             std::int64_t rowid);

}  // namespace rockyard::batch
