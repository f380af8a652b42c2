// The tables of a result store: how they are made, written and read. result_store.cc alone uses it.
// Must stay: tables, columns and keys of `meta` (result_store.h), and the order of columns, in
// which the checksum of a row takes them. Functions that read throw StoreError kDamaged where they
// meet what no version of this program writes.
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

// What a store says of itself, besides its trials. It is kept in the tables `meta` (the campaign as
// a whole, by key), `cells`, `columns` and `builds`.
struct StoreHead {
  CampaignIdentity identity;          // with the first of the builds
  std::vector<std::int64_t> planned;  // trials, by cell
  std::optional<StoppingRule> rule;
  std::vector<std::int64_t> most_planned = {};  // ever, by cell: no trial beyond them is stored
};

// Makes every table, in one transaction, with checksums. The most planned trials are those planned
// now.
void WriteStoreHead(SqliteDatabase& database, const StoreHead& head);

// Reads the head. Throws kMismatch for a store of another version.
StoreHead ReadStoreHead(const SqliteDatabase& database);

// Returns a name as SQL writes it, in double quotes.
std::string QuotedName(std::string_view name);

void WritePlanned(SqliteDatabase& database, int cell, std::int64_t planned);

std::vector<std::string> ReadBuilds(const SqliteDatabase& database);
// Adds a build, unless it is there already.
void AddBuild(SqliteDatabase& database, std::string_view build);

void InsertFault(SqliteDatabase& database, const InfrastructureFault& fault);
// Reads the infrastructure faults of a store of that many cells.
std::vector<InfrastructureFault> ReadFaults(const SqliteDatabase& database, int cells);

// What the table of trials is written by, and what its rows must fit. `identity` and `most_planned`
// must outlive it.
struct TrialTable {
  const CampaignIdentity& identity;
  const std::vector<std::int64_t>& most_planned;
};

// Adds the records in one transaction. A trial that is already there keeps its first record. No
// value may be infinite.
void InsertRecords(SqliteDatabase& database, const TrialTable& table,
                   std::span<const CellRecord> records);

// Moves the simulator faults, with what each said, from the table of trials to that of
// infrastructure faults, in one transaction: these trials are pending again. Returns how many there
// were.
std::int64_t SetSimulatorFaultsAside(SqliteDatabase& database);

// The trials from .. to-1 of a cell.
struct TrialRange {
  int cell = 0;
  std::int64_t from = 0;
  std::int64_t to = 0;
};

// Returns the records that there are of a range, by trial index. Throws kDamaged where a row does
// not fit its checksum, or holds what no trial gives.
std::vector<truth::Record> SelectRecords(const SqliteDatabase& database, const TrialTable& table,
                                         const TrialRange& range);

// Returns the records that there are of a range, with the values of these columns alone and without
// the sentences that say why trials ended. Checks the outcomes, and not the values: CheckRecords
// does.
std::vector<truth::Record> SelectColumns(const SqliteDatabase& database, const TrialTable& table,
                                         const truth::RecordSchema& columns,
                                         const TrialRange& range);

// Throws as SelectRecords does, and keeps nothing.
void CheckRecords(const SqliteDatabase& database, const TrialTable& table, const TrialRange& range);

// Returns every stored trial by cell and trial index, read in one SqliteSnapshot of its own. Throws
// kDamaged also where rows are missing, foreign, of another shard, or of trials that were never
// planned.
std::vector<FinishedTrial> SelectFinished(const SqliteDatabase& database, const TrialTable& table);

// The most trials that a cell may have, as scenarios and stopping rules limit them.
inline constexpr std::int64_t kMostTrials = 1'000'000'000;

using Meta = std::map<std::string, std::string, std::less<>>;

void WriteRule(SqliteDatabase& database, const std::optional<StoppingRule>& rule);

}  // namespace rockyard::batch
