// The tables of a result store: how they are made, written and read.
#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "batch/campaign.h"
#include "batch/sqlite_database.h"
#include "batch/store_rows.h"
#include "batch/work_plan.h"

namespace rockyard::batch {

// What a store says of itself, besides its trials.
struct StoreHead {
  CampaignIdentity identity;          // with the first of the builds
  std::vector<std::int64_t> planned;  // trials, by cell
  std::optional<StoppingRule> rule;
  Checksums checksums = Checksums::kEachRow;
  std::vector<std::int64_t> most_planned = {};  // ever, by cell: no trial beyond them is stored
};

// Makes every table, in one transaction, with checksums and the most trials that are planned now.
void WriteStoreHead(SqliteDatabase& database, const StoreHead& head);

// kMismatch: another version; kDamaged: what no version of this program writes.
StoreHead ReadStoreHead(const SqliteDatabase& database);

// A name as SQL writes it, in double quotes.
std::string QuotedName(std::string_view name);

void WritePlanned(SqliteDatabase& database, Checksums checksums, int cell, std::int64_t planned);

std::vector<std::string> ReadBuilds(const SqliteDatabase& database, Checksums checksums);
// One that is there already stays.
void AddBuild(SqliteDatabase& database, Checksums checksums, std::string_view build);

void InsertFault(SqliteDatabase& database, Checksums checksums, const InfrastructureFault& fault);
// Of that many cells. kDamaged.
std::vector<InfrastructureFault> ReadFaults(const SqliteDatabase& database, Checksums checksums,
                                            int cells);

// What the table of trials is written by, and what its rows must fit. All of it outlives this.
struct TrialTable {
  const CampaignIdentity& identity;
  const std::vector<std::int64_t>& most_planned;
  Checksums checksums = Checksums::kEachRow;
};

// Adds the records in one transaction. A trial that is already there keeps its first record. No
// value is infinite.
void InsertRecords(SqliteDatabase& database, const TrialTable& table,
                   std::span<const CellRecord> records);

// Takes the simulator faults out of the table, each into that of infrastructure faults with what it
// said, in one transaction: they are pending again. How many there were.
std::int64_t SetSimulatorFaultsAside(SqliteDatabase& database, const TrialTable& table);

// Trials from .. to-1 of a cell.
struct TrialRange {
  int cell = 0;
  std::int64_t from = 0;
  std::int64_t to = 0;
};

// The records there are of those, by trial index. Throws kDamaged where a row does not fit its
// checksum, or holds what no trial gives.
std::vector<truth::Record> SelectRecords(const SqliteDatabase& database, const TrialTable& table,
                                         const TrialRange& range);

// The same with the values of these columns alone and without the sentences that say why trials
// ended. Checks the outcomes, and not the values: CheckRecords does.
std::vector<truth::Record> SelectColumns(const SqliteDatabase& database, const TrialTable& table,
                                         const truth::RecordSchema& columns,
                                         const TrialRange& range);

// Throws as SelectRecords does, and keeps nothing.
void CheckRecords(const SqliteDatabase& database, const TrialTable& table, const TrialRange& range);

// Every stored trial by cell and trial index, in one SqliteSnapshot of its own. Throws kDamaged
// also where rows are missing, foreign, of another shard, or of trials that were never planned.
std::vector<FinishedTrial> SelectFinished(const SqliteDatabase& database, const TrialTable& table);

// The table `meta`: what a store says of the campaign as a whole, by key.

// Most trials of a cell, as scenarios and stopping rules have it.
inline constexpr std::int64_t kMostTrials = 1'000'000'000;

using Meta = std::map<std::string, std::string, std::less<>>;

// By the version of the store alone. kMismatch: another version; kDamaged: the version is not that
// of the tables.
Checksums ReadChecksums(const SqliteDatabase& database);

void WriteRule(SqliteDatabase& database, Checksums checksums,
               const std::optional<StoppingRule>& rule);

}  // namespace rockyard::batch
