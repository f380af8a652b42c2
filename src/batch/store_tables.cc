#include "batch/store_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "batch/campaign_differences.h"
#include "batch/sqlite_database.h"
#include "core/error.h"
#include "core/json_text.h"
#include "experiments/make_experiment.h"

namespace rockyard::batch {
namespace {

constexpr std::string_view kMetaTable = "meta";

namespace fs = std::filesystem;

// The version of the layout of all tables. Stores outlive programs: a change of tables or columns
// that other versions would misread must take another number, which these versions then refuse.
constexpr std::int64_t kSchemaVersion = 3;

constexpr TableShape kMeta{kMetaTable, "key, value", 2};

void PutMeta(SqliteDatabase& database, std::string_view key, std::string_view value) {
  SqliteStatement update = database.Prepare("UPDATE meta SET value = ? WHERE key = ?");
  update.Bind(0, value).Bind(1, key).Step();
  if (database.Changes() == 0) {
    RowInsert insert(database, kMeta);
    insert.Add(key).Add(value).Write();
    return insert.Finish();
  }
  SqliteStatement row = database.Prepare("SELECT rowid FROM meta WHERE key = ?");
  if (row.Bind(0, key).Step()) SealRow(database, kMeta, row.Integer(0));
}

// Reads a decimal number from 0 on.
template <typename Number>
Number ParseNumber(const fs::path& path, std::string_view key, const std::string& text) {
  Number value = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc{} && result.ptr == end && value >= 0) return value;
  FailDamaged(path, fmt::format("has {} = \"{}\", which is no such number", key, text));
}

// Returns an entry. GetMeta, GetNumber and the readers below throw kDamaged, which names the file.
const std::string& GetMeta(const fs::path& path, const Meta& meta, std::string_view key) {
  const auto found = meta.find(key);
  if (found == meta.end()) {
    FailDamaged(path, fmt::format("lacks the entry {} of a result store", key));
  }
  return found->second;
}

template <typename Number>
Number GetNumber(const fs::path& path, const Meta& meta, std::string_view key) {
  return ParseNumber<Number>(path, key, GetMeta(path, meta, key));
}

// Reads a number of trials, 0 .. kMostTrials.
std::int64_t ParseTrials(const fs::path& path, std::string_view key, const std::string& text) {
  const auto trials = ParseNumber<std::int64_t>(path, key, text);
  if (trials <= kMostTrials) return trials;
  FailDamaged(path, fmt::format("has {} = {}, and no cell has more than {} trials", key, trials,
                                kMostTrials));
}

// Writes version, name, design, shard and settings of a new store.
void WriteMeta(SqliteDatabase& database, const CampaignIdentity& identity) {
  const auto put = [&](std::string_view key, std::string_view value) {
    PutMeta(database, key, value);
  };
  put("schema_version", std::to_string(kSchemaVersion));
  put("name", identity.name);
  put("design", identity.design);
  put("shard_index", std::to_string(identity.shard.index));
  put("shard_count", std::to_string(identity.shard.count));
  if (identity.settings) put("settings", core::DumpJson(core::ListOf(*identity.settings)));
}

Meta ReadMeta(const SqliteDatabase& database) {
  Meta meta;
  CheckedRows rows(database, kMeta, "rowid");
  while (rows.Step()) meta[rows.row().Text(0)] = rows.row().Text(1);
  return meta;
}

Shard ReadShard(const fs::path& path, const Meta& meta) {
  const Shard shard{GetNumber<int>(path, meta, "shard_index"),
                    GetNumber<int>(path, meta, "shard_count")};
  if (shard.index < 1 || shard.index > shard.count) {
    FailDamaged(path,
                fmt::format("is shard {} of {}, which there is not", shard.index, shard.count));
  }
  return shard;
}

std::optional<StoppingRule> ReadRule(const fs::path& path, const Meta& meta) {
  const std::string& name = GetMeta(path, meta, "rule");
  if (name == "none") return std::nullopt;
  const StoppingRule rule{
      .half_width = GetNumber<double>(path, meta, "rule_half_width"),
      .max_trials = ParseTrials(path, "rule_max_trials", GetMeta(path, meta, "rule_max_trials")),
      .block = GetNumber<std::int64_t>(path, meta, "rule_block"),
      .confidence = GetNumber<double>(path, meta, "rule_confidence"),
      .allocation = name == "adaptive" ? Allocation::kAdaptive : Allocation::kUniform,
      .budget = GetNumber<std::int64_t>(path, meta, "rule_budget"),
  };
  const bool named = name == "adaptive" || name == "uniform";
  const bool possible = rule.block >= 1 && rule.half_width < 0.5 && rule.confidence > 0.0 &&
                        rule.confidence < 1.0 && ReadShard(path, meta).whole();
  if (!named || !possible) FailDamaged(path, "has an impossible stopping rule");
  return rule;
}

// Reads the design: the JSON text of an object, or "".
std::string ReadDesign(const fs::path& path, const Meta& meta) {
  const std::string& design = GetMeta(path, meta, "design");
  try {
    if (design.empty() || core::ParseJson(design, "design").Is(core::JsonValue::Type::kObject)) {
      return design;
    }
  } catch (const core::UserError&) {
    // FailDamaged below tells it.
  }
  FailDamaged(path, "has a design that is no object");
}

// Reads the settings; absent where the store was begun without them.
std::optional<std::vector<std::string>> ReadSettings(const fs::path& path, const Meta& meta) {
  const auto found = meta.find("settings");
  if (found == meta.end()) return std::nullopt;
  try {
    if (auto texts = core::TextsIn(core::ParseJson(found->second, "settings"))) return texts;
  } catch (const core::UserError&) {
    // FailDamaged below tells it.
  }
  FailDamaged(path, "has settings that are no list of texts");
}

constexpr TableShape kCells{
    "cells", "cell, name, scenario, fingerprint, resolved, seed, planned, most_planned", 8};
constexpr TableShape kColumns{"columns", "position, name, unit, meaning", 4};
constexpr TableShape kBuilds{"builds", "build", 1};
constexpr TableShape kFaults{"infrastructure_faults", "cell, trial, kind, detail", 4};

// How many columns the table of trials has besides those of the values: the keys and the checksums.
// Must agree with kFixedColumns in store_trials.cc.
constexpr std::int64_t kOtherTrialColumns = 6;

std::string CreateTrialsSql(const truth::RecordSchema& schema) {
  // The first column is campaign_cell, since records may have a column "cell" of their own. Must
  // stay: the order, in which TrialInsert (store_trials.cc) binds values; its statement names no
  // columns.
  std::string sql =
      "CREATE TABLE trials(campaign_cell INTEGER NOT NULL, trial INTEGER NOT NULL, "
      "outcome TEXT NOT NULL, detail TEXT NOT NULL";
  for (const truth::ValueInfo& value : schema) sql += ", " + QuotedName(value.name);
  return sql +
         ", outcome_checksum INTEGER NOT NULL, row_checksum INTEGER NOT NULL, "
         "PRIMARY KEY (campaign_cell, trial))";
}

void CreateTables(SqliteDatabase& database, const truth::RecordSchema& schema) {
  database.Execute(
      "CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL, row_checksum INTEGER NOT "
      "NULL)");
  database.Execute(
      "CREATE TABLE columns(position INTEGER PRIMARY KEY, name TEXT, unit TEXT, meaning TEXT, "
      "row_checksum INTEGER NOT NULL)");
  database.Execute("CREATE TABLE builds(build TEXT PRIMARY KEY, row_checksum INTEGER NOT NULL)");
  // The seed is a text, because SQLite has no unsigned numbers of 64 bits.
  database.Execute(
      "CREATE TABLE cells(cell INTEGER PRIMARY KEY, name TEXT NOT NULL, scenario TEXT NOT NULL, "
      "fingerprint TEXT NOT NULL, resolved TEXT NOT NULL, seed TEXT NOT NULL, planned NOT NULL, "
      "most_planned NOT NULL, row_checksum INTEGER NOT NULL)");
  database.Execute(
      "CREATE TABLE infrastructure_faults(cell INTEGER NOT NULL, trial INTEGER NOT NULL, "
      "kind TEXT NOT NULL, detail TEXT NOT NULL, row_checksum INTEGER NOT NULL)");
  database.Execute(CreateTrialsSql(schema));
  CreateInventory(database);
  for (const std::string_view table :
       {kMetaTable, kColumns.name, kBuilds.name, kCells.name, kFaults.name, kTrialsTable}) {
    SetInventory(database, table, {});
  }
}

void InsertColumns(SqliteDatabase& database, const truth::RecordSchema& schema) {
  RowInsert insert(database, kColumns);
  for (std::size_t i = 0; i < schema.size(); ++i) {
    const truth::ValueInfo& value = schema[i];
    insert.Add(static_cast<std::int64_t>(i)).Add(value.name).Add(value.unit).Add(value.meaning);
    insert.Write();
  }
  insert.Finish();
}

void InsertCells(SqliteDatabase& database, const StoreHead& head) {
  RowInsert insert(database, kCells);
  for (std::size_t i = 0; i < head.identity.cells.size(); ++i) {
    const CellIdentity& cell = head.identity.cells[i];
    insert.Add(static_cast<std::int64_t>(i)).Add(cell.name).Add(cell.scenario);
    insert.Add(cell.fingerprint).Add(cell.resolved).Add(std::to_string(cell.seed));
    insert.Add(head.planned[i]).Add(head.planned[i]).Write();
  }
  insert.Finish();
}

truth::RecordSchema ReadColumns(const SqliteDatabase& database) {
  truth::RecordSchema stored;
  CheckedRows rows(database, kColumns, "position");
  while (rows.Step()) {
    stored.push_back({rows.row().Text(1), rows.row().Text(2), rows.row().Text(3)});
  }
  SqliteStatement count = database.Prepare("SELECT count(*) FROM pragma_table_info('trials')");
  if (!count.Step() ||
      count.Integer(0) != static_cast<std::int64_t>(stored.size()) + kOtherTrialColumns) {
    FailDamaged(database.path(), "is damaged: table columns does not list those of table trials");
  }
  return experiments::WithRoles(std::move(stored));
}

core::JsonValue ParseResolved(const std::string& resolved) {
  try {
    return core::ParseJson(resolved, "resolved");
  } catch (const core::UserError&) {
    return {};  // fits no fingerprint
  }
}

// Returns a text or an integer as text; "" for anything else.
std::string Plain(const core::JsonValue& value) {
  if (value.Is(core::JsonValue::Type::kInteger)) return std::to_string(value.integer());
  return value.Is(core::JsonValue::Type::kText) ? value.text() : std::string();
}

// Returns the column of a cell that does not fit its resolved scenario, which says the same of the
// cell; "" where all fit.
std::string_view Contradiction(const CellIdentity& cell) {
  const core::JsonValue resolved = ParseResolved(cell.resolved);
  if (ResolvedFingerprint(resolved) != cell.fingerprint) return "fingerprint";
  const core::JsonValue* seed = resolved.Find("seed");
  if (seed != nullptr && Plain(*seed) != std::to_string(cell.seed)) return "seed";
  const core::JsonValue* name = resolved.Find("name");
  return name != nullptr && Plain(*name) != cell.scenario ? "scenario" : "";
}

void RequireOneScenario(const SqliteDatabase& database, std::size_t row, const CellIdentity& cell) {
  const std::string_view column = Contradiction(cell);
  if (column.empty()) return;
  FailDamaged(
      database.path(),
      fmt::format("is damaged: table cells, row {}, column resolved: it does not fit column "
                  "{}",
                  row, column));
}

void RequireNewName(const SqliteDatabase& database, const std::vector<CellIdentity>& cells,
                    const std::string& name) {
  const bool taken = std::any_of(cells.begin(), cells.end(),
                                 [&](const CellIdentity& cell) { return cell.name == name; });
  if (taken) {
    FailDamaged(database.path(),
                fmt::format("is damaged: table cells has the name \"{}\" twice", name));
  }
}

void ReadCells(const SqliteDatabase& database, StoreHead& head) {
  CheckedRows rows(database, kCells, "cell");
  while (rows.Step()) {
    const SqliteStatement& row = rows.row();
    if (row.Integer(0) != static_cast<std::int64_t>(head.identity.cells.size())) {
      FailDamaged(database.path(), "has cells that are not numbered 0, 1, 2, ...");
    }
    RequireNewName(database, head.identity.cells, row.Text(1));
    head.identity.cells.push_back(
        {row.Text(1), row.Text(2), row.Text(3), row.Text(4),
         ParseNumber<std::uint64_t>(database.path(), "seed", row.Text(5))});
    head.planned.push_back(ParseTrials(database.path(), "planned", row.Text(6)));
    head.most_planned.push_back(ParseTrials(database.path(), "most_planned", row.Text(7)));
    RequireOneScenario(database, head.identity.cells.size() - 1, head.identity.cells.back());
  }
  if (head.planned.empty()) FailDamaged(database.path(), "has no cell");
}

// kMismatch: another version, of which nothing else is read.
void RequireVersion(const SqliteDatabase& database) {
  SqliteStatement select = database.Prepare("SELECT value FROM meta WHERE key = 'schema_version'");
  if (!select.Step())
    FailDamaged(database.path(), "lacks the entry schema_version of a result store");
  const auto version = ParseNumber<std::int64_t>(database.path(), "schema_version", select.Text(0));
  if (version == kSchemaVersion) return;
  throw StoreError(StoreProblem::kMismatch, database.path().string(),
                   fmt::format("has version {}, not {}", version, kSchemaVersion),
                   "use the program that made it, or another folder");
}

}  // namespace

void WritePlanned(SqliteDatabase& database, int cell, std::int64_t planned) {
  SqliteStatement update = database.Prepare(
      "UPDATE cells SET planned = ?1, most_planned = max(most_planned, ?1) WHERE cell = ?2");
  update.Bind(0, planned).Bind(1, static_cast<std::int64_t>(cell)).Step();
  SealRow(database, kCells, cell);
}

void AddBuild(SqliteDatabase& database, std::string_view build) {
  RowInsert insert(database, kBuilds, OnConflict::kKeepFirst);
  insert.Add(build).Write();
  insert.Finish();
}

void InsertFault(SqliteDatabase& database, const InfrastructureFault& fault) {
  RowInsert insert(database, kFaults);
  insert.Add(static_cast<std::int64_t>(fault.id.cell)).Add(fault.id.trial);
  insert.Add(fault.kind).Add(fault.detail).Write();
  insert.Finish();
}

std::vector<InfrastructureFault> ReadFaults(const SqliteDatabase& database, int cells) {
  std::vector<InfrastructureFault> faults;
  CheckedRows rows(database, kFaults, "rowid");
  while (rows.Step()) {
    const SqliteStatement& row = rows.row();
    if (row.Integer(0) < 0 || row.Integer(0) >= cells || row.Integer(1) < 0) {
      FailDamaged(database.path(),
                  fmt::format("is damaged: table {}: there is no trial {} of cell {}", kFaults.name,
                              row.Integer(1), row.Integer(0)));
    }
    faults.push_back(
        {{static_cast<int>(row.Integer(0)), row.Integer(1)}, row.Text(2), row.Text(3)});
  }
  return faults;
}

std::string QuotedName(std::string_view name) {
  std::string quoted(1, '"');
  for (const char c : name) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void WriteStoreHead(SqliteDatabase& database, const StoreHead& head) {
  const CampaignIdentity& identity = head.identity;
  SqliteTransaction transaction(database);
  CreateTables(database, identity.schema);
  WriteMeta(database, identity);
  WriteRule(database, head.rule);
  AddBuild(database, identity.build);
  InsertColumns(database, identity.schema);
  InsertCells(database, head);
  transaction.Commit();
}

StoreHead ReadStoreHead(const SqliteDatabase& database) {
  const SqliteSnapshot snapshot(database);
  StoreHead head;
  RequireVersion(database);
  const Meta meta = ReadMeta(database);
  head.identity.name = GetMeta(database.path(), meta, "name");
  head.identity.design = ReadDesign(database.path(), meta);
  head.identity.shard = ReadShard(database.path(), meta);
  head.identity.settings = ReadSettings(database.path(), meta);
  head.identity.schema = ReadColumns(database);
  head.rule = ReadRule(database.path(), meta);
  ReadCells(database, head);
  const std::vector<std::string> builds = ReadBuilds(database);
  if (!builds.empty()) head.identity.build = builds.front();
  return head;
}

std::vector<std::string> ReadBuilds(const SqliteDatabase& database) {
  std::vector<std::string> builds;
  CheckedRows rows(database, kBuilds, "rowid");
  while (rows.Step()) builds.push_back(rows.row().Text(0));
  return builds;
}

void WriteRule(SqliteDatabase& database, const std::optional<StoppingRule>& rule) {
  const auto put = [&](std::string_view key, std::string_view value) {
    PutMeta(database, key, value);
  };
  if (!rule) return put("rule", "none");
  put("rule_half_width", fmt::format("{}", rule->half_width));
  put("rule_max_trials", std::to_string(rule->max_trials));
  put("rule_block", std::to_string(rule->block));
  put("rule_confidence", fmt::format("{}", rule->confidence));
  put("rule_budget", std::to_string(rule->budget));
  put("rule", rule->allocation == Allocation::kAdaptive ? "adaptive" : "uniform");
}

}  // namespace rockyard::batch
