#include "batch/store_tables.h"

#include <fmt/format.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "batch/store_error.h"
#include "core/json_text.h"
#include "experiments/experiment.h"

namespace rockyard::batch {
namespace {

constexpr std::int64_t kSchemaVersion = 2;

std::string CreateTrialsSql(const truth::RecordSchema& schema) {
  // Records may have a column "cell" of their own.
  std::string sql =
      "CREATE TABLE trials(campaign_cell INTEGER NOT NULL, trial INTEGER NOT NULL, "
      "outcome TEXT NOT NULL, detail TEXT NOT NULL";
  for (const truth::ValueInfo& value : schema) sql += ", " + QuotedName(value.name);
  return sql + ", PRIMARY KEY (campaign_cell, trial))";
}

void PutMeta(SqliteDatabase& database, std::string_view key, std::string_view value) {
  SqliteStatement put = database.Prepare("INSERT OR REPLACE INTO meta VALUES (?, ?)");
  put.Bind(0, key).Bind(1, value).Step();
}

std::string GetMeta(const SqliteDatabase& database, std::string_view key) {
  SqliteStatement get = database.Prepare("SELECT value FROM meta WHERE key = ?");
  if (!get.Bind(0, key).Step()) {
    FailDamaged(database.path(), fmt::format("lacks the entry {} of a result store", key));
  }
  return get.Text(0);
}

template <typename Number>
Number ParseNumber(const SqliteDatabase& database, std::string_view key, const std::string& text) {
  Number value = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc{} && result.ptr == end && value >= 0) return value;
  FailDamaged(database.path(), fmt::format("has {} = \"{}\", which is no such number", key, text));
}

template <typename Number>
Number GetNumber(const SqliteDatabase& database, std::string_view key) {
  return ParseNumber<Number>(database, key, GetMeta(database, key));
}

void CreateTables(SqliteDatabase& database, const truth::RecordSchema& schema) {
  database.Execute("CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL)");
  database.Execute(
      "CREATE TABLE columns(position INTEGER PRIMARY KEY, name TEXT, unit TEXT, meaning TEXT)");
  database.Execute("CREATE TABLE builds(build TEXT PRIMARY KEY)");
  // The seed is a text, because SQLite has no unsigned numbers of 64 bits.
  database.Execute(
      "CREATE TABLE cells(cell INTEGER PRIMARY KEY, name TEXT NOT NULL, scenario TEXT NOT NULL, "
      "fingerprint TEXT NOT NULL, resolved TEXT NOT NULL, seed TEXT NOT NULL, planned NOT NULL)");
  database.Execute(
      "CREATE TABLE infrastructure_faults(cell INTEGER NOT NULL, trial INTEGER NOT NULL, "
      "kind TEXT NOT NULL, detail TEXT NOT NULL)");
  database.Execute(CreateTrialsSql(schema));
}

void InsertColumns(SqliteDatabase& database, const truth::RecordSchema& schema) {
  SqliteStatement column = database.Prepare("INSERT INTO columns VALUES (?, ?, ?, ?)");
  for (std::size_t i = 0; i < schema.size(); ++i) {
    const truth::ValueInfo& value = schema[i];
    column.Bind(0, static_cast<std::int64_t>(i)).Bind(1, value.name).Bind(2, value.unit);
    column.Bind(3, value.meaning).Step();
    column.Reset();
  }
}

void InsertCells(SqliteDatabase& database, const StoreHead& head) {
  SqliteStatement insert = database.Prepare("INSERT INTO cells VALUES (?, ?, ?, ?, ?, ?, ?)");
  for (std::size_t i = 0; i < head.identity.cells.size(); ++i) {
    const CellIdentity& cell = head.identity.cells[i];
    insert.Bind(0, static_cast<std::int64_t>(i)).Bind(1, cell.name).Bind(2, cell.scenario);
    insert.Bind(3, cell.fingerprint).Bind(4, cell.resolved).Bind(5, std::to_string(cell.seed));
    insert.Bind(6, head.planned[i]).Step();
    insert.Reset();
  }
}

void ReadCells(const SqliteDatabase& database, StoreHead& head) {
  SqliteStatement select = database.Prepare(
      "SELECT cell, name, scenario, fingerprint, resolved, seed, planned FROM cells ORDER BY cell");
  while (select.Step()) {
    if (select.Integer(0) != static_cast<std::int64_t>(head.identity.cells.size())) {
      FailDamaged(database.path(), "has cells that are not numbered 0, 1, 2, ...");
    }
    head.identity.cells.push_back({select.Text(1), select.Text(2), select.Text(3), select.Text(4),
                                   ParseNumber<std::uint64_t>(database, "seed", select.Text(5))});
    head.planned.push_back(ParseNumber<std::int64_t>(database, "planned", select.Text(6)));
  }
  if (head.planned.empty()) FailDamaged(database.path(), "has no cell");
}

Shard ReadShard(const SqliteDatabase& database) {
  const Shard shard{GetNumber<int>(database, "shard_index"),
                    GetNumber<int>(database, "shard_count")};
  if (shard.index < 1 || shard.index > shard.count) {
    FailDamaged(database.path(),
                fmt::format("is shard {} of {}, which there is not", shard.index, shard.count));
  }
  return shard;
}

std::optional<StoppingRule> ReadRule(const SqliteDatabase& database) {
  if (GetMeta(database, "rule") == "none") return std::nullopt;
  const bool adaptive = GetMeta(database, "rule") == "adaptive";
  const StoppingRule rule{
      .half_width = GetNumber<double>(database, "rule_half_width"),
      .max_trials = GetNumber<std::int64_t>(database, "rule_max_trials"),
      .block = GetNumber<std::int64_t>(database, "rule_block"),
      .confidence = GetNumber<double>(database, "rule_confidence"),
      .allocation = adaptive ? Allocation::kAdaptive : Allocation::kUniform,
      .budget = GetNumber<std::int64_t>(database, "rule_budget"),
  };
  if (rule.block < 1 || !(rule.confidence > 0.0 && rule.confidence < 1.0)) {
    FailDamaged(database.path(), "has an impossible stopping rule");
  }
  return rule;
}

// A JSON list of texts.
void PutSettings(SqliteDatabase& database, const std::vector<std::string>& settings) {
  PutMeta(database, "settings", core::DumpJson(core::ListOf(settings)));
}

// Nothing in the stores of older programs.
std::optional<std::vector<std::string>> ReadSettings(const SqliteDatabase& database) {
  SqliteStatement get = database.Prepare("SELECT value FROM meta WHERE key = 'settings'");
  if (!get.Step()) return std::nullopt;
  try {
    if (auto texts = core::TextsIn(core::ParseJson(get.Text(0), "settings"))) return texts;
  } catch (const core::UserError&) {
    // Told below.
  }
  FailDamaged(database.path(), "has settings that are no list of texts");
}

}  // namespace

void WriteRule(SqliteDatabase& database, const std::optional<StoppingRule>& rule) {
  if (!rule) return PutMeta(database, "rule", "none");
  PutMeta(database, "rule_half_width", fmt::format("{}", rule->half_width));
  PutMeta(database, "rule_max_trials", std::to_string(rule->max_trials));
  PutMeta(database, "rule_block", std::to_string(rule->block));
  PutMeta(database, "rule_confidence", fmt::format("{}", rule->confidence));
  PutMeta(database, "rule_budget", std::to_string(rule->budget));
  PutMeta(database, "rule", rule->allocation == Allocation::kAdaptive ? "adaptive" : "uniform");
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
  PutMeta(database, "schema_version", std::to_string(kSchemaVersion));
  PutMeta(database, "name", identity.name);
  PutMeta(database, "design", identity.design);
  PutMeta(database, "shard_index", std::to_string(identity.shard.index));
  PutMeta(database, "shard_count", std::to_string(identity.shard.count));
  if (identity.settings) PutSettings(database, *identity.settings);
  WriteRule(database, head.rule);
  database.Prepare("INSERT INTO builds VALUES (?)").Bind(0, identity.build).Step();
  InsertColumns(database, identity.schema);
  InsertCells(database, head);
  transaction.Commit();
}

StoreHead ReadStoreHead(const SqliteDatabase& database) {
  const auto version = GetNumber<std::int64_t>(database, "schema_version");
  if (version != kSchemaVersion) {
    throw StoreError(StoreProblem::kMismatch, database.path().string(),
                     fmt::format("has version {}, not {}", version, kSchemaVersion),
                     "use the program that made it, or another folder");
  }
  StoreHead head;
  head.identity.name = GetMeta(database, "name");
  head.identity.design = GetMeta(database, "design");
  head.identity.shard = ReadShard(database);
  head.identity.settings = ReadSettings(database);
  truth::RecordSchema stored;
  SqliteStatement columns =
      database.Prepare("SELECT name, unit, meaning FROM columns ORDER BY position");
  while (columns.Step()) {
    stored.push_back({columns.Text(0), columns.Text(1), columns.Text(2)});
  }
  head.identity.schema = experiments::WithRoles(std::move(stored));
  ReadCells(database, head);
  head.rule = ReadRule(database);
  const std::vector<std::string> builds = ReadBuilds(database);
  if (!builds.empty()) head.identity.build = builds.front();
  return head;
}

std::vector<std::string> ReadBuilds(const SqliteDatabase& database) {
  std::vector<std::string> builds;
  SqliteStatement select = database.Prepare("SELECT build FROM builds ORDER BY rowid");
  while (select.Step()) builds.push_back(select.Text(0));
  return builds;
}

}  // namespace rockyard::batch
