// The tables of a result store: how they are made, written and read.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "batch/campaign.h"
#include "batch/sqlite_database.h"
#include "batch/stopping_rule.h"

namespace rockyard::batch {

// What a store says of itself, besides its trials.
struct StoreHead {
  CampaignIdentity identity;          // with the first of the builds
  std::vector<std::int64_t> planned;  // trials, by cell
  std::optional<StoppingRule> rule;
};

// Makes every table, in one transaction.
void WriteStoreHead(SqliteDatabase& database, const StoreHead& head);

// kMismatch: another version; kDamaged: what no version of this program writes.
StoreHead ReadStoreHead(const SqliteDatabase& database);

// A name as SQL writes it, in double quotes.
std::string QuotedName(std::string_view name);

void WriteRule(SqliteDatabase& database, const std::optional<StoppingRule>& rule);

std::vector<std::string> ReadBuilds(const SqliteDatabase& database);

// Adds the records in one transaction. A trial that is already there keeps its first record.
void InsertRecords(SqliteDatabase& database, const truth::RecordSchema& schema,
                   std::span<const CellRecord> records);

// Trials from .. to-1 of a cell.
struct TrialRange {
  int cell = 0;
  std::int64_t from = 0;
  std::int64_t to = 0;
};

// Whether records come with the sentence that says why they ended.
enum class Sentences { kKept, kLeftOut };

// The records there are of those, by trial index, with the values of these columns. kDamaged.
std::vector<truth::Record> SelectRecords(const SqliteDatabase& database,
                                         const truth::RecordSchema& columns,
                                         const TrialRange& range,
                                         Sentences sentences = Sentences::kKept);

// Every stored trial by cell and trial index. kDamaged.
std::vector<FinishedTrial> SelectFinished(const SqliteDatabase& database, int cells);

}  // namespace rockyard::batch
