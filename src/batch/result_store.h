// The store of one campaign: every finished trial, durable, in one SQLite file. Campaigns write it;
// reports, replays, comparisons and all other commands that take the folder of a run read it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "batch/campaign.h"
#include "batch/campaign_differences.h"
#include "batch/work_plan.h"
#include "truth/record.h"

namespace rockyard::batch {

class SqliteDatabase;
struct TrialTable;

// The file `results.sqlite` in a run folder. Tables, version 3:
//   meta(key, value)                        schema version, name, design, shard, stopping rule
//   cells(cell, name, scenario, fingerprint, resolved, seed, planned, most_planned)
//   columns(position, name, unit, meaning)  the record schema
//   builds(build)                           every build that wrote trials
//   trials(campaign_cell, trial, outcome, detail, one column per value, outcome_checksum)
//   infrastructure_faults(cell, trial, kind, detail)   no results: counted, retried
//   inventory(table_name, rows, checksums)  how many rows each table has, and their checksums' sum
// Every table has a last column row_checksum. Value columns have no declared type, because a REAL
// column would lose the sign of zero; doubles keep their bits, and NaN is NULL. A simulator fault
// has NULL in every value column. Must stay: tables and columns, as stores outlive programs;
// another layout takes another version (kSchemaVersion in store_tables.cc).
//
// Damage: what is read is checked (store_rows.h), and so is that the rows are all there and none
// is foreign. A store that was changed by accident is refused (kDamaged) rather than giving another
// result. Head and rows are checked as they are read, the table of trials as a whole by Finished.
//
// Durability: commits are synchronous, through a write-ahead log. Records for which Append has
// returned survive a killed process and a power cut (as far as the disk keeps its promises). The
// end of the object brings the log into the file, unless somebody reads it just then. Every failure
// is a StoreError; the functions below name its StoreProblem (kExists, ...). One thread at a time
// may call it, and a folder has one writer (hold a FolderClaim).
class ResultStore {
 public:
  // Makes the store; there must be none. `planned`: trials of each cell. The store appears whole,
  // with all that is told here. Throws kExists, kUnwritable, kFull, kOpenFiles.
  static ResultStore Create(const std::filesystem::path& folder, const CampaignIdentity& identity,
                            const std::vector<std::int64_t>& planned);
  // Create with the same number of trials for every cell.
  static ResultStore Create(const std::filesystem::path& folder, const CampaignIdentity& identity,
                            std::int64_t planned);

  // Opens the store to go on, once all that it holds has been checked. Throws kMissing, kDamaged,
  // and kMismatch with every difference (campaign_differences.h, and the shard).
  static ResultStore Resume(const std::filesystem::path& folder, const CampaignIdentity& identity,
                            BuildPolicy policy = BuildPolicy::kSame);

  // Returns false where there is no store, or one that holds nothing, not even what it is a store
  // of: earlier versions of the program left such a store behind when they were killed early.
  // Throws kDamaged.
  static bool HasBegun(const std::filesystem::path& folder);

  // Throws as Resume does, and changes nothing.
  static void RequireSame(const std::filesystem::path& folder, const CampaignIdentity& identity,
                          BuildPolicy policy);

  // Opens the store to read, also while a run writes it, and without a right to write. Leaves no
  // files; may need room for a copy in the temporary folder (sqlite_database.h). Throws kMissing,
  // kDamaged.
  static ResultStore Read(const std::filesystem::path& folder);

  ResultStore(ResultStore&&) noexcept;
  ResultStore& operator=(ResultStore&&) noexcept;
  ~ResultStore();

  const CampaignIdentity& identity() const { return identity_; }
  int cells() const { return static_cast<int>(identity_.cells.size()); }
  const std::filesystem::path& path() const { return path_; }
  // The planned trials of the whole cell, also where the store is of one shard.
  std::int64_t planned(int cell = 0) const { return planned_.at(static_cast<std::size_t>(cell)); }
  std::vector<std::string> Builds() const;

  // Notes another build that wrote some of the trials.
  void AddBuild(std::string_view build);

  void SetPlanned(int cell, std::int64_t planned);

  // The rule that ended, or will end, the cells; absent: every planned trial is run.
  const std::optional<StoppingRule>& rule() const { return rule_; }
  void SetRule(const std::optional<StoppingRule>& rule);

  // Adds records in one transaction; all are durable when it returns, none when it throws. A trial
  // that is already there keeps its first record. Each record must fit the schema, without an
  // infinite value, or be a fault.
  void Append(std::span<const CellRecord> records);

  // Makes trials that ended in a simulator fault pending again, for a user who knows that the
  // machine was at fault. What each said is kept as an infrastructure fault. Returns how many there
  // were.
  std::int64_t RetryFaults();

  // Returns the stored records of a cell, by trial index. Trials beyond those planned stay in the
  // store and are not loaded: an earlier session ran more than the stopping rule of today asks for,
  // and the campaign is the same as if they had not run. Cost: reads all of them into memory, some
  // 500 bytes for each drive (truth/value_table.h).
  std::vector<truth::Record> Load(int cell = 0) const;
  // Returns the records of a cell with the values of these columns of the schema alone, in this
  // order, and without the sentences that say why trials ended: 96 bytes and the values for each.
  // Checks the outcomes; call Check for the values.
  std::vector<truth::Record> Load(int cell, const truth::RecordSchema& columns) const;
  // Returns the records with from <= trial < to, planned or not.
  std::vector<truth::Record> Load(int cell, std::int64_t from, std::int64_t to) const;

  // Throws kDamaged where a stored record of the cell, planned or not, does not fit its checksum.
  // Reads all that Load(cell) reads, and keeps nothing.
  void Check(int cell) const;

  // Returns every stored trial, planned or not, without its values, by cell and trial: 24 bytes for
  // each. Throws kDamaged also where trials are missing, foreign, or were never planned.
  std::vector<FinishedTrial> Finished() const;

  // Notes something that kept a trial from its result. Durable when it returns.
  void AddInfrastructureFault(const InfrastructureFault& fault);
  std::vector<InfrastructureFault> InfrastructureFaults() const;

 private:
  ResultStore(std::filesystem::path path, std::unique_ptr<SqliteDatabase> database);
  TrialTable Trials() const;

  std::filesystem::path path_;
  std::unique_ptr<SqliteDatabase> database_;
  CampaignIdentity identity_;
  std::vector<std::int64_t> planned_;
  std::optional<StoppingRule> rule_;
  std::vector<std::int64_t> most_planned_;  // ever, by cell
};

// Returns the records 0, 1, 2, ... up to the first trial that is missing: what rates may be
// computed from (PrefixCounter). `records` must be ordered by trial index.
std::span<const truth::Record> ContiguousPrefix(std::span<const truth::Record> records);

}  // namespace rockyard::batch
