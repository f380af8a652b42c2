#include "batch/store_meta.h"

#include <fmt/format.h>

#include "batch/store_error.h"
#include "core/error.h"
#include "core/json_text.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSchemaVersion = 3;
constexpr std::int64_t kVersionWithoutChecksums = 2;

constexpr TableShape kMeta{kMetaTable, "key, value", 2};

void PutMeta(SqliteDatabase& database, Checksums checksums, std::string_view key,
             std::string_view value) {
  SqliteStatement update = database.Prepare("UPDATE meta SET value = ? WHERE key = ?");
  update.Bind(0, value).Bind(1, key).Step();
  if (database.Changes() == 0) {
    RowInsert insert(database, checksums, kMeta);
    insert.Add(key).Add(value).Write();
    return insert.Finish();
  }
  SqliteStatement row = database.Prepare("SELECT rowid FROM meta WHERE key = ?");
  if (row.Bind(0, key).Step()) SealRow(database, checksums, kMeta, row.Integer(0));
}

template <typename Number>
Number GetNumber(const fs::path& path, const Meta& meta, std::string_view key) {
  return ParseNumber<Number>(path, key, GetMeta(path, meta, key));
}

}  // namespace

void FailNumber(const fs::path& path, std::string_view key, const std::string& text) {
  FailDamaged(path, fmt::format("has {} = \"{}\", which is no such number", key, text));
}

std::int64_t ParseTrials(const fs::path& path, std::string_view key, const std::string& text) {
  const auto trials = ParseNumber<std::int64_t>(path, key, text);
  if (trials <= kMostTrials) return trials;
  FailDamaged(path, fmt::format("has {} = {}, and no cell has more than {} trials", key, trials,
                                kMostTrials));
}

Checksums ReadChecksums(const SqliteDatabase& database) {
  SqliteStatement select = database.Prepare("SELECT value FROM meta WHERE key = 'schema_version'");
  if (!select.Step())
    FailDamaged(database.path(), "lacks the entry schema_version of a result store");
  const auto version = ParseNumber<std::int64_t>(database.path(), "schema_version", select.Text(0));
  if (version != kSchemaVersion && version != kVersionWithoutChecksums) {
    throw StoreError(StoreProblem::kMismatch, database.path().string(),
                     fmt::format("has version {}, not {}", version, kSchemaVersion),
                     "use the program that made it, or another folder");
  }
  SqliteStatement tables =
      database.Prepare("SELECT count(*) FROM sqlite_master WHERE name = 'inventory'");
  const bool inventory = tables.Step() && tables.Integer(0) > 0;
  if (inventory != (version == kSchemaVersion)) {
    FailDamaged(database.path(),
                fmt::format("is damaged: table meta, row schema_version, column value: {} in a "
                            "store {} checksums",
                            version, inventory ? "with" : "without"));
  }
  return inventory ? Checksums::kEachRow : Checksums::kNone;
}

void WriteMeta(SqliteDatabase& database, const CampaignIdentity& identity) {
  const auto put = [&](std::string_view key, std::string_view value) {
    PutMeta(database, Checksums::kEachRow, key, value);
  };
  put("schema_version", std::to_string(kSchemaVersion));
  put("name", identity.name);
  put("design", identity.design);
  put("shard_index", std::to_string(identity.shard.index));
  put("shard_count", std::to_string(identity.shard.count));
  if (identity.settings) put("settings", core::DumpJson(core::ListOf(*identity.settings)));
}

void WriteRule(SqliteDatabase& database, Checksums checksums,
               const std::optional<StoppingRule>& rule) {
  const auto put = [&](std::string_view key, std::string_view value) {
    PutMeta(database, checksums, key, value);
  };
  if (!rule) return put("rule", "none");
  put("rule_half_width", fmt::format("{}", rule->half_width));
  put("rule_max_trials", std::to_string(rule->max_trials));
  put("rule_block", std::to_string(rule->block));
  put("rule_confidence", fmt::format("{}", rule->confidence));
  put("rule_budget", std::to_string(rule->budget));
  put("rule", rule->allocation == Allocation::kAdaptive ? "adaptive" : "uniform");
}

Meta ReadMeta(const SqliteDatabase& database, Checksums checksums) {
  Meta meta;
  CheckedRows rows(database, checksums, kMeta, "rowid");
  while (rows.Step()) meta[rows.row().Text(0)] = rows.row().Text(1);
  return meta;
}

const std::string& GetMeta(const fs::path& path, const Meta& meta, std::string_view key) {
  const auto found = meta.find(key);
  if (found == meta.end()) {
    FailDamaged(path, fmt::format("lacks the entry {} of a result store", key));
  }
  return found->second;
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

std::string ReadDesign(const fs::path& path, const Meta& meta) {
  const std::string& design = GetMeta(path, meta, "design");
  try {
    if (design.empty() || core::ParseJson(design, "design").Is(core::JsonValue::Type::kObject)) {
      return design;
    }
  } catch (const core::UserError&) {
    // Told below.
  }
  FailDamaged(path, "has a design that is no object");
}

std::optional<std::vector<std::string>> ReadSettings(const fs::path& path, const Meta& meta) {
  const auto found = meta.find("settings");
  if (found == meta.end()) return std::nullopt;
  try {
    if (auto texts = core::TextsIn(core::ParseJson(found->second, "settings"))) return texts;
  } catch (const core::UserError&) {
    // Told below.
  }
  FailDamaged(path, "has settings that are no list of texts");
}

}  // namespace rockyard::batch
