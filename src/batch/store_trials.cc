// The table of trials, row by row.
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <utility>

#include "batch/store_error.h"
#include "batch/store_tables.h"
#include "core/check.h"

namespace rockyard::batch {
namespace {

constexpr int kFixedColumns = 4;  // campaign_cell, trial, outcome, detail

std::string InsertSql(std::size_t values) {
  std::string sql = "INSERT OR IGNORE INTO trials VALUES (?, ?, ?, ?";
  for (std::size_t i = 0; i < values; ++i) sql += ", ?";
  return sql + ")";
}

std::string SelectSql(const truth::RecordSchema& schema) {
  std::string sql = "SELECT campaign_cell, trial, outcome, detail";
  for (const truth::ValueInfo& value : schema) sql += ", " + QuotedName(value.name);
  return sql + " FROM trials WHERE campaign_cell = ? AND trial >= ? AND trial < ? ORDER BY trial";
}

std::int64_t CheckedTrial(const SqliteDatabase& database, std::int64_t trial) {
  if (trial < 0) {
    FailDamaged(database.path(), fmt::format("has a trial with the index {}", trial));
  }
  return trial;
}

truth::TrialOutcome OutcomeOf(const SqliteDatabase& database, std::int64_t trial,
                              const std::string& name) {
  for (std::size_t i = 0; i < truth::kTrialOutcomeNames.size(); ++i) {
    if (truth::kTrialOutcomeNames[i] == name) return static_cast<truth::TrialOutcome>(i);
  }
  FailDamaged(database.path(),
              fmt::format("has the unknown outcome \"{}\" at trial {}", name, trial));
}

void ReadValues(const SqliteDatabase& database, const truth::RecordSchema& schema,
                const SqliteStatement& row, std::span<double> values) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < schema.size(); ++i) {
    const int column = kFixedColumns + static_cast<int>(i);
    if (!row.IsNull(column) && !row.IsReal(column)) {
      FailDamaged(database.path(),
                  fmt::format("has no number in {} of trial {}", schema[i].name, row.Integer(1)));
    }
    values[i] = row.IsNull(column) ? kNan : row.Real(column);
  }
}

}  // namespace

void InsertRecords(SqliteDatabase& database, const truth::RecordSchema& schema,
                   std::span<const CellRecord> records) {
  SqliteTransaction transaction(database);
  SqliteStatement insert = database.Prepare(InsertSql(schema.size()));
  for (const CellRecord& each : records) {
    const truth::Record& record = each.record;
    const bool fault = truth::IsFault(record);
    EXPECT(fault || record.values.size() == schema.size());
    insert.Bind(0, static_cast<std::int64_t>(each.cell));
    insert.Bind(1, static_cast<std::int64_t>(record.trial));
    insert.Bind(2, truth::Name(record.outcome)).Bind(3, record.detail);
    for (std::size_t i = 0; i < schema.size(); ++i) {
      const int parameter = kFixedColumns + static_cast<int>(i);
      if (fault) {
        insert.BindNull(parameter);
      } else {
        insert.Bind(parameter, record.values[i]);
      }
    }
    insert.Step();
    insert.Reset();
  }
  transaction.Commit();
}

std::vector<truth::Record> SelectRecords(const SqliteDatabase& database,
                                         const truth::RecordSchema& columns,
                                         const TrialRange& range, Sentences sentences) {
  std::vector<truth::Record> records;
  const auto values = std::make_shared<truth::ValueTable>(columns.size());
  std::vector<double> row(columns.size());
  SqliteStatement select = database.Prepare(SelectSql(columns));
  select.Bind(0, static_cast<std::int64_t>(range.cell)).Bind(1, range.from).Bind(2, range.to);
  while (select.Step()) {
    truth::Record record;
    const std::int64_t trial = CheckedTrial(database, select.Integer(1));
    record.trial = static_cast<std::uint64_t>(trial);
    record.outcome = OutcomeOf(database, trial, select.Text(2));
    if (sentences == Sentences::kKept) record.detail = select.Text(3);
    if (!truth::IsFault(record)) {
      ReadValues(database, columns, select, row);
      record.values = {values, values->rows()};
      values->Append(row);
    }
    records.push_back(std::move(record));
  }
  return records;
}

std::vector<FinishedTrial> SelectFinished(const SqliteDatabase& database, int cells) {
  std::vector<FinishedTrial> finished;
  SqliteStatement select = database.Prepare(
      "SELECT campaign_cell, trial, outcome FROM trials ORDER BY campaign_cell, trial");
  while (select.Step()) {
    const std::int64_t cell = select.Integer(0);
    const std::int64_t trial = CheckedTrial(database, select.Integer(1));
    if (cell < 0 || cell >= cells) {
      FailDamaged(database.path(), fmt::format("has a trial of cell {}, which there is not", cell));
    }
    finished.push_back(
        {{static_cast<int>(cell), trial}, OutcomeOf(database, trial, select.Text(2))});
  }
  return finished;
}

}  // namespace rockyard::batch
