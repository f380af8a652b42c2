// The table `meta`: what a store says of the campaign as a whole, by key.
#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "batch/campaign.h"
#include "batch/sqlite_database.h"
#include "batch/stopping_rule.h"
#include "batch/store_rows.h"

namespace rockyard::batch {

inline constexpr std::string_view kMetaTable = "meta";

// Most trials of a cell, as scenarios and stopping rules have it.
inline constexpr std::int64_t kMostTrials = 1'000'000'000;

using Meta = std::map<std::string, std::string, std::less<>>;

// By the version of the store alone. kMismatch: another version; kDamaged: the version is not that
// of the tables.
Checksums ReadChecksums(const SqliteDatabase& database);

// Name, design, shard and settings of a new store.
void WriteMeta(SqliteDatabase& database, const CampaignIdentity& identity);
void WriteRule(SqliteDatabase& database, Checksums checksums,
               const std::optional<StoppingRule>& rule);

Meta ReadMeta(const SqliteDatabase& database, Checksums checksums);
// These throw kDamaged, which names the file.
const std::string& GetMeta(const std::filesystem::path& path, const Meta& meta,
                           std::string_view key);
Shard ReadShard(const std::filesystem::path& path, const Meta& meta);
std::optional<StoppingRule> ReadRule(const std::filesystem::path& path, const Meta& meta);
// JSON text of an object, or nothing.
std::string ReadDesign(const std::filesystem::path& path, const Meta& meta);
// Nothing in the stores of older programs.
std::optional<std::vector<std::string>> ReadSettings(const std::filesystem::path& path,
                                                     const Meta& meta);

[[noreturn]] void FailNumber(const std::filesystem::path& path, std::string_view key,
                             const std::string& text);

// A decimal number from 0 on.
template <typename Number>
Number ParseNumber(const std::filesystem::path& path, std::string_view key,
                   const std::string& text) {
  Number value = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc{} && result.ptr == end && value >= 0) return value;
  FailNumber(path, key, text);
}

// 0 .. kMostTrials.
std::int64_t ParseTrials(const std::filesystem::path& path, std::string_view key,
                         const std::string& text);

}  // namespace rockyard::batch
