// The table of trials, row by row, for ResultStore (declared in store_tables.h).
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "batch/sqlite_database.h"
#include "batch/store_tables.h"
#include "core/check.h"
#include "truth/measurement_record.h"

namespace rockyard::batch {
namespace {

// Must agree with kOtherTrialColumns and CreateTrialsSql in store_tables.cc.
constexpr int kFixedColumns = 4;  // campaign_cell, trial, outcome, detail
constexpr int kOutcomeColumn = 2;

// Returns what the rows of each cell begin their checksums with: its scenario and its seed, so that
// rows of another campaign do not fit. Must stay: stored checksums depend on it.
std::vector<std::int64_t> RowBeginnings(const CampaignIdentity& identity) {
  std::vector<std::int64_t> beginnings;
  beginnings.reserve(identity.cells.size());
  RowChecksum checksum;
  for (const CellIdentity& cell : identity.cells) {
    checksum.Restart();
    checksum.Text(cell.fingerprint).Integer(static_cast<std::int64_t>(cell.seed));
    beginnings.push_back(checksum.value());
  }
  return beginnings;
}

// OR IGNORE: a trial that was run twice has the same record, and the first row stays.
std::string InsertSql(std::size_t values) {
  std::string sql = "INSERT OR IGNORE INTO trials VALUES (?, ?, ?, ?";
  for (std::size_t i = 0; i < values; ++i) sql += ", ?";
  return sql + ", ?, ?)";
}

// Reads along the index; SelectFinished checks its order and entries.
constexpr std::string_view kFrom =
    ", outcome_checksum, row_checksum FROM trials INDEXED BY sqlite_autoindex_trials_1";

std::string SelectSql(std::string_view detail, const truth::RecordSchema& columns) {
  std::string sql = fmt::format("SELECT campaign_cell, trial, outcome, {}", detail);
  for (const truth::ValueInfo& value : columns) sql += ", " + QuotedName(value.name);
  return fmt::format("{}{} WHERE campaign_cell = ? AND trial >= ? AND trial < ? ORDER BY trial",
                     sql, kFrom);
}

// Reads rows of the table of trials and checks each.
class TrialReader {
 public:
  TrialReader(const SqliteDatabase& database, const TrialTable& table, std::string_view sql)
      : database_(database),
        table_(table),
        row_(database.Prepare(sql)),
        beginnings_(RowBeginnings(table.identity)) {}

  SqliteStatement& row() { return row_; }
  TrialId id() const { return id_; }
  truth::TrialOutcome outcome() const { return outcome_; }

  // Steps to the next row, and returns whether there is one. Its checksums are in the columns
  // `sums` and `sums` + 1.
  bool Step(int sums) {
    if (!row_.Step()) return false;
    CheckId();
    outcome_text_ = row_.Text(kOutcomeColumn);
    checksum_.Restart(beginnings_[static_cast<std::size_t>(id_.cell)]);
    checksum_.Integer(id_.cell).Integer(id_.trial).Text(outcome_text_);
    RequireSum(sums, "outcome_checksum");
    outcome_ = Outcome();
    return true;
  }

  // Reads the values from kFixedColumns on, and checks the row with its detail and all values.
  void ReadRow(const truth::RecordSchema& schema, std::string_view detail,
               std::span<double> values) {
    checksum_.Text(detail);
    for (std::size_t i = 0; i < schema.size(); ++i) {
      values[i] = Value(kFixedColumns + static_cast<int>(i), schema[i]);
      checksum_.Real(values[i]);
    }
    RequireSum(kFixedColumns + 1 + static_cast<int>(schema.size()), "row_checksum");
    for (std::size_t i = 0; i < schema.size(); ++i) RequireAtMostBase(schema, values, i);
  }

  double Value(int column, const truth::ValueInfo& info) const {
    switch (row_.Type(column)) {
      case ValueType::kNull:
        return std::numeric_limits<double>::quiet_NaN();
      case ValueType::kReal:
        break;
      default:
        FailRow(info.name, "no number");
    }
    const double value = row_.Real(column);
    if (std::isinf(value)) FailRow(info.name, "an infinite value");
    if (value < 0.0 && (truth::IsBase(info.role) || truth::IsCount(info.role))) {
      FailRow(info.name, fmt::format("a count of {}", value));
    }
    return value;
  }

 private:
  // Refuses a count above its base. Bases that are lengths (unit m) bound no count.
  void RequireAtMostBase(const truth::RecordSchema& schema, std::span<const double> values,
                         std::size_t count) const {
    if (!truth::IsCount(schema[count].role)) return;
    const truth::ValueInfo* base = truth::FindColumn(schema, schema[count].of);
    if (base == nullptr || base->unit != "1") return;
    const double most = values[static_cast<std::size_t>(base - schema.data())];
    if (values[count] > most) {
      FailRow(schema[count].name, fmt::format("{} of {} {}", values[count], most, base->name));
    }
  }

  [[noreturn]] void FailRow(std::string_view column, std::string_view what) const {
    FailDamaged(database_.path(),
                fmt::format("is damaged: table trials, cell {}, trial {}, column {}: {}",
                            row_.Integer(0), row_.Integer(1), column, what));
  }

  void CheckId() {
    const std::int64_t cell = row_.Integer(0);
    const std::int64_t trial = row_.Integer(1);
    if (cell < 0 || cell >= static_cast<std::int64_t>(beginnings_.size())) {
      FailRow("campaign_cell", "there is no such cell");
    }
    const std::int64_t most = table_.most_planned[static_cast<std::size_t>(cell)];
    if (trial < 0 || trial >= most) {
      FailRow("trial", fmt::format("at most {} were ever planned, from 0 on", most));
    }
    const Shard& shard = table_.identity.shard;
    if (!shard.Has(trial)) {
      FailRow("trial", fmt::format("it is none of shard {}/{}", shard.index, shard.count));
    }
    id_ = {static_cast<int>(cell), trial};
  }

  void RequireSum(int column, std::string_view name) {
    if (row_.Integer(column) != checksum_.value()) FailRow(name, "it does not fit the row");
  }

  truth::TrialOutcome Outcome() const {
    for (std::size_t i = 0; i < truth::kTrialOutcomeNames.size(); ++i) {
      if (truth::kTrialOutcomeNames[i] == outcome_text_) return static_cast<truth::TrialOutcome>(i);
    }
    FailRow("outcome", fmt::format("the unknown outcome \"{}\"", outcome_text_));
  }

  const SqliteDatabase& database_;
  const TrialTable& table_;
  SqliteStatement row_;
  const std::vector<std::int64_t> beginnings_;
  RowChecksum checksum_;
  std::string outcome_text_;
  TrialId id_;
  truth::TrialOutcome outcome_ = truth::TrialOutcome::kSimulatorFault;
};

// Writes rows of the table of trials with their checksums.
class TrialInsert {
 public:
  TrialInsert(SqliteDatabase& database, const TrialTable& table)
      : database_(database),
        table_(table),
        insert_(database.Prepare(InsertSql(table.identity.schema.size()))),
        beginnings_(RowBeginnings(table.identity)),
        tally_(InventoryOf(database, kTrialsTable)) {}

  void Write(const CellRecord& each) {
    const truth::Record& record = each.record;
    checksum_.Restart(beginnings_.at(static_cast<std::size_t>(each.cell)));
    Key(0, each.cell);
    Key(1, static_cast<std::int64_t>(record.trial));
    Text(kOutcomeColumn, truth::Name(record.outcome));
    const std::int64_t outcome_sum = checksum_.value();
    Text(kOutcomeColumn + 1, record.detail);
    const int values = static_cast<int>(table_.identity.schema.size());
    for (int i = 0; i < values; ++i) Value(kFixedColumns + i, record, static_cast<std::size_t>(i));
    const std::int64_t sum = checksum_.value();
    insert_.Bind(kFixedColumns + values, outcome_sum).Bind(kFixedColumns + values + 1, sum);
    insert_.Step();
    insert_.Reset();
    if (database_.Changes() > 0) tally_.Add(sum);
  }

  void Finish() { SetInventory(database_, kTrialsTable, tally_); }

 private:
  void Key(int parameter, std::int64_t value) {
    insert_.Bind(parameter, value);
    checksum_.Integer(value);
  }

  void Text(int parameter, std::string_view value) {
    insert_.Bind(parameter, value);
    checksum_.Text(value);
  }

  // Binds a value; a fault has none.
  void Value(int parameter, const truth::Record& record, std::size_t i) {
    if (truth::IsFault(record)) {
      insert_.BindNull(parameter);
      checksum_.Null();
      return;
    }
    EXPECT(!std::isinf(record.values[i]));
    insert_.Bind(parameter, record.values[i]);
    checksum_.Real(record.values[i]);
  }

  SqliteDatabase& database_;
  const TrialTable& table_;
  SqliteStatement insert_;
  const std::vector<std::int64_t> beginnings_;
  RowChecksum checksum_;
  TableTally tally_;
};

void Bind(SqliteStatement& select, const TrialRange& range) {
  select.Bind(0, static_cast<std::int64_t>(range.cell)).Bind(1, range.from).Bind(2, range.to);
}

}  // namespace

void InsertRecords(SqliteDatabase& database, const TrialTable& table,
                   std::span<const CellRecord> records) {
  SqliteTransaction transaction(database);
  TrialInsert insert(database, table);
  for (const CellRecord& each : records) {
    EXPECT(truth::IsFault(each.record) ||
           each.record.values.size() == table.identity.schema.size());
    insert.Write(each);
  }
  insert.Finish();
  transaction.Commit();
}

std::int64_t SetSimulatorFaultsAside(SqliteDatabase& database) {
  const std::string fault(truth::Name(truth::TrialOutcome::kSimulatorFault));
  const std::string where = " FROM trials WHERE outcome = ?1";
  SqliteTransaction transaction(database);
  TableTally tally = InventoryOf(database, kTrialsTable);
  SqliteStatement select =
      database.Prepare("SELECT campaign_cell, trial, detail, row_checksum" + where);
  select.Bind(0, fault);
  std::int64_t number = 0;
  for (; select.Step(); ++number) {
    const TrialId id{static_cast<int>(select.Integer(0)), select.Integer(1)};
    InsertFault(database, {id, fault, select.Text(2)});
    tally.Remove(select.Integer(3));
  }
  database.Prepare("DELETE" + where).Bind(0, fault).Step();
  SetInventory(database, kTrialsTable, tally);
  transaction.Commit();
  return number;
}

std::vector<truth::Record> SelectRecords(const SqliteDatabase& database, const TrialTable& table,
                                         const TrialRange& range) {
  const truth::RecordSchema& schema = table.identity.schema;
  std::vector<truth::Record> records;
  const auto values = std::make_shared<truth::ValueTable>(schema.size());
  std::vector<double> row(schema.size());
  TrialReader reader(database, table, SelectSql("detail", schema));
  Bind(reader.row(), range);
  while (reader.Step(kFixedColumns + static_cast<int>(schema.size()))) {
    truth::Record record;
    record.trial = static_cast<std::uint64_t>(reader.id().trial);
    record.outcome = reader.outcome();
    record.detail = reader.row().Text(kOutcomeColumn + 1);
    reader.ReadRow(schema, record.detail, row);
    if (!truth::IsFault(record)) {
      record.values = {values, values->rows()};
      values->Append(row);
    }
    records.push_back(std::move(record));
  }
  return records;
}

void CheckRecords(const SqliteDatabase& database, const TrialTable& table,
                  const TrialRange& range) {
  const truth::RecordSchema& schema = table.identity.schema;
  std::vector<double> row(schema.size());
  TrialReader reader(database, table, SelectSql("detail", schema));
  Bind(reader.row(), range);
  while (reader.Step(kFixedColumns + static_cast<int>(schema.size()))) {
    reader.ReadRow(schema, reader.row().Text(kOutcomeColumn + 1), row);
  }
}

std::vector<truth::Record> SelectColumns(const SqliteDatabase& database, const TrialTable& table,
                                         const truth::RecordSchema& columns,
                                         const TrialRange& range) {
  std::vector<truth::Record> records;
  const auto values = std::make_shared<truth::ValueTable>(columns.size());
  std::vector<double> row(columns.size());
  TrialReader reader(database, table, SelectSql("''", columns));
  Bind(reader.row(), range);
  while (reader.Step(kFixedColumns + static_cast<int>(columns.size()))) {
    truth::Record record;
    record.trial = static_cast<std::uint64_t>(reader.id().trial);
    record.outcome = reader.outcome();
    if (!truth::IsFault(record)) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        row[i] = reader.Value(kFixedColumns + static_cast<int>(i), columns[i]);
      }
      record.values = {values, values->rows()};
      values->Append(row);
    }
    records.push_back(std::move(record));
  }
  return records;
}

std::vector<FinishedTrial> SelectFinished(const SqliteDatabase& database, const TrialTable& table) {
  const SqliteSnapshot snapshot(database);
  std::vector<FinishedTrial> finished;
  TableTally tally;
  TrialReader reader(
      database, table,
      fmt::format("SELECT campaign_cell, trial, outcome{} ORDER BY campaign_cell, trial", kFrom));
  while (reader.Step(kOutcomeColumn + 1)) {
    const TrialId id = reader.id();
    const bool ascending =
        finished.empty() || finished.back().id.cell < id.cell ||
        (finished.back().id.cell == id.cell && finished.back().id.trial < id.trial);
    if (!ascending) {
      FailDamaged(database.path(), fmt::format("is damaged: table trials has trial {} of cell {} "
                                               "twice or in the wrong place",
                                               id.trial, id.cell));
    }
    finished.push_back({id, reader.outcome()});
    tally.Add(reader.row().Integer(kOutcomeColumn + 2));
  }
  CheckInventory(database, kTrialsTable, tally);
  return finished;
}

}  // namespace rockyard::batch
