#include "batch/store_rows.h"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>

#include "batch/sqlite_database.h"

namespace rockyard::batch {
namespace {

constexpr TableShape kInventory{"inventory", "table_name, rows, checksums", 3};

std::string SelectSql(const TableShape& table) {
  return fmt::format("SELECT {}, row_checksum FROM {}", table.columns, table.name);
}

std::string InsertSql(const TableShape& table, OnConflict on_conflict) {
  std::string values = "?";
  for (int i = 0; i < table.count; ++i) values += ", ?";
  return fmt::format("INSERT {}INTO {} VALUES ({})",
                     on_conflict == OnConflict::kKeepFirst ? "OR IGNORE " : "", table.name, values);
}

std::int64_t InventoryChecksum(std::string_view table, const TableTally& tally) {
  RowChecksum checksum;
  checksum.Text(table).Integer(tally.rows);
  return checksum.Integer(static_cast<std::int64_t>(tally.checksums)).value();
}

}  // namespace

void TableTally::Add(std::int64_t checksum) {
  ++rows;
  checksums += static_cast<std::uint64_t>(checksum);
}

void TableTally::Remove(std::int64_t checksum) {
  --rows;
  checksums -= static_cast<std::uint64_t>(checksum);
}

void CreateInventory(SqliteDatabase& database) {
  database.Execute(
      "CREATE TABLE inventory(table_name TEXT PRIMARY KEY, rows INTEGER NOT NULL, "
      "checksums INTEGER NOT NULL, row_checksum INTEGER NOT NULL)");
}

TableTally InventoryOf(const SqliteDatabase& database, std::string_view table) {
  SqliteStatement select = database.Prepare(SelectSql(kInventory) + " WHERE table_name = ?");
  if (!select.Bind(0, table).Step()) {
    FailDamaged(database.path(), fmt::format("is damaged: table inventory lacks {}", table));
  }
  const TableTally tally{select.Integer(1), static_cast<std::uint64_t>(select.Integer(2))};
  if (select.Text(0) != table || select.Integer(3) != InventoryChecksum(table, tally)) {
    FailDamaged(database.path(),
                fmt::format("is damaged: table inventory, row {}, column row_checksum: it does not "
                            "fit the row",
                            table));
  }
  return tally;
}

void SetInventory(SqliteDatabase& database, std::string_view table, const TableTally& tally) {
  SqliteStatement put = database.Prepare("INSERT OR REPLACE INTO inventory VALUES (?, ?, ?, ?)");
  put.Bind(0, table).Bind(1, tally.rows).Bind(2, static_cast<std::int64_t>(tally.checksums));
  put.Bind(3, InventoryChecksum(table, tally)).Step();
}

void CheckInventory(const SqliteDatabase& database, std::string_view table,
                    const TableTally& found) {
  const TableTally written = InventoryOf(database, table);
  if (found == written) return;
  if (found.rows != written.rows) {
    FailDamaged(database.path(),
                fmt::format("is damaged: table {} has {} rows where {} were written", table,
                            found.rows, written.rows));
  }
  FailDamaged(
      database.path(),
      fmt::format("is damaged: table {} has other rows than those that were written", table));
}

CheckedRows::CheckedRows(const SqliteDatabase& database, const TableShape& table,
                         std::string_view order)
    : database_(database),
      table_(table),
      select_(database.Prepare(fmt::format("{} ORDER BY {}", SelectSql(table), order))) {}

bool CheckedRows::Step() {
  if (!select_.Step()) {
    CheckInventory(database_, table_.name, found_);
    return false;
  }
  checksum_.Restart();
  const std::int64_t stored = select_.Integer(table_.count);
  if (checksum_.Columns(select_, table_.count).value() != stored) {
    FailDamaged(database_.path(),
                fmt::format("is damaged: table {}, row {} (of {}), column row_checksum: it does "
                            "not fit the row",
                            table_.name, found_.rows, select_.Text(0)));
  }
  found_.Add(stored);
  return true;
}

RowInsert::RowInsert(SqliteDatabase& database, const TableShape& table, OnConflict on_conflict)
    : database_(database),
      table_(table),
      insert_(database.Prepare(InsertSql(table, on_conflict))),
      tally_(InventoryOf(database, table.name)) {}

RowInsert& RowInsert::Add(std::int64_t value) {
  insert_.Bind(next_++, value);
  checksum_.Integer(value);
  return *this;
}

RowInsert& RowInsert::Add(std::string_view value) {
  insert_.Bind(next_++, value);
  checksum_.Text(value);
  return *this;
}

void RowInsert::Write() {
  const std::int64_t checksum = checksum_.value();
  insert_.Bind(next_, checksum);
  insert_.Step();
  insert_.Reset();
  if (database_.Changes() > 0) {
    tally_.Add(checksum);
    added_ = true;
  }
  checksum_.Restart();
  next_ = 0;
}

void RowInsert::Finish() {
  if (added_) SetInventory(database_, table_.name, tally_);
}

void SealRow(SqliteDatabase& database, const TableShape& table, std::int64_t rowid) {
  SqliteStatement select = database.Prepare(SelectSql(table) + " WHERE rowid = ?");
  if (!select.Bind(0, rowid).Step()) {
    FailDamaged(database.path(),
                fmt::format("is damaged: table {} lacks row {}", table.name, rowid));
  }
  RowChecksum checksum;
  const std::int64_t sum = checksum.Columns(select, table.count).value();
  TableTally tally = InventoryOf(database, table.name);
  tally.Remove(select.Integer(table.count));
  tally.Add(sum);
  SqliteStatement update =
      database.Prepare(fmt::format("UPDATE {} SET row_checksum = ? WHERE rowid = ?", table.name));
  update.Bind(0, sum).Bind(1, rowid).Step();
  SetInventory(database, table.name, tally);
}

void RowChecksum::Restart(std::int64_t before) {
  sum_ = static_cast<std::uint32_t>(before);
  bytes_.clear();
}

RowChecksum& RowChecksum::Null() {
  bytes_ += 'N';
  return *this;
}

RowChecksum& RowChecksum::Integer(std::int64_t value) {
  Number('I', static_cast<std::uint64_t>(value));
  return *this;
}

RowChecksum& RowChecksum::Real(double value) {
  if (std::isnan(value)) return Null();
  Number('R', std::bit_cast<std::uint64_t>(value));
  return *this;
}

RowChecksum& RowChecksum::Text(std::string_view value) {
  Number('T', value.size());
  bytes_ += value;
  return *this;
}

RowChecksum& RowChecksum::Columns(const SqliteStatement& row, int columns) {
  for (int column = 0; column < columns; ++column) {
    switch (row.Type(column)) {
      case ValueType::kNull:
        Null();
        break;
      case ValueType::kInteger:
        Integer(row.Integer(column));
        break;
      case ValueType::kReal:
        Real(row.Real(column));
        break;
      case ValueType::kText:
        Text(row.Text(column));
        break;
    }
  }
  return *this;
}

std::int64_t RowChecksum::value() {
  const auto* bytes = reinterpret_cast<const Bytef*>(bytes_.data());
  sum_ = static_cast<std::uint32_t>(crc32_z(sum_, bytes, bytes_.size()));
  bytes_.clear();
  return sum_;
}

void RowChecksum::Number(char type, std::uint64_t bits) {
  std::array<char, 9> bytes{type};
  for (std::size_t i = 1; i < bytes.size(); ++i, bits >>= 8) bytes[i] = static_cast<char>(bits);
  bytes_.append(bytes.data(), bytes.size());
}

}  // namespace rockyard::batch
