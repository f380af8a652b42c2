// The store of one campaign: every finished trial, durable, in one SQLite file.
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
enum class Checksums;
struct TrialTable;

// The file `results.sqlite` in a run folder. Tables, version 3:
//   meta(key, value)                        schema version, name, design, shard, stopping rule
//   cells(cell, name, scenario, fingerprint, resolved, seed, planned, most_planned)
//   columns(position, name, unit, meaning)  the record schema
//   builds(build)                           every build that wrote trials
//   trials(campaign_cell, trial, outcome, detail, one column per value, outcome_checksum)
//   infrastructure_faults(cell, trial, kind, detail)   no results: counted, retried
//   inventory(table_name, rows, checksums)  how many rows each table has, and their checksums' sum
// and in each a last column row_checksum. Value columns have no declared type, because a REAL
// column would lose the sign of zero; doubles keep their bits, and NaN is NULL. A simulator fault
// has NULL everywhere.
//
// Damage: what is read is checked (store_rows.h), and so is that the rows are all there and none
// is foreign, so that a store that was changed by accident is refused (kDamaged) rather than giving
// another result. Head and rows are checked as they are read, the table of trials as a whole by
// Finished. Stores of version 2 have no checksums: of them only what no trial gives is refused.
//
// Durability: write-ahead log with a synchronous commit: what Append has returned for survives a
// killed process and a power cut (as far as the disk keeps its promises). The end of the object
// brings the log into the file, unless somebody reads it just then. Every failure is a StoreError.
// One thread at a time; one writer per folder (hold a FolderClaim).
class ResultStore {
 public:
  // Makes the store; there must be none. `planned`: trials of each cell. The store appears whole,
  // with all that is told here. kExists, kUnwritable, kFull, kOpenFiles.
  static ResultStore Create(const std::filesystem::path& folder, const CampaignIdentity& identity,
                            const std::vector<std::int64_t>& planned);
  // The same number of trials for every cell.
  static ResultStore Create(const std::filesystem::path& folder, const CampaignIdentity& identity,
                            std::int64_t planned);

  // Opens the store to go on, once all that it holds has been checked. kMissing, kDamaged, and
  // kMismatch with every difference (campaign_differences.h, and the shard).
  static ResultStore Resume(const std::filesystem::path& folder, const CampaignIdentity& identity,
                            BuildPolicy policy = BuildPolicy::kSame);

  // False where there is no store, or one that holds nothing, not even what it is a store of, as
  // earlier versions of the program left behind when they were killed early. kDamaged.
  static bool HasBegun(const std::filesystem::path& folder);

  // Throws as Resume does, and changes nothing.
  static void RequireSame(const std::filesystem::path& folder, const CampaignIdentity& identity,
                          BuildPolicy policy);

  // Opens the store to read, also while a run writes it, and without a right to write. Leaves no
  // files; may need room for a copy in the temporary folder (sqlite_database.h). kMissing,
  // kDamaged.
  static ResultStore Read(const std::filesystem::path& folder);

  ResultStore(ResultStore&&) noexcept;
  ResultStore& operator=(ResultStore&&) noexcept;
  ~ResultStore();

  const CampaignIdentity& identity() const { return identity_; }
  int cells() const { return static_cast<int>(identity_.cells.size()); }
  const std::filesystem::path& path() const { return path_; }
  // Trials of the whole cell, also where this is a shard of it.
  std::int64_t planned(int cell = 0) const { return planned_.at(static_cast<std::size_t>(cell)); }
  std::vector<std::string> Builds() const;

  // Another build that wrote some of the trials.
  void AddBuild(std::string_view build);

  void SetPlanned(int cell, std::int64_t planned);

  // False in stores of older programs: damage that leaves possible values passes unseen.
  bool has_checksums() const;

  // The rule that ended, or will end, the cells; none: every planned trial is run.
  const std::optional<StoppingRule>& rule() const { return rule_; }
  void SetRule(const std::optional<StoppingRule>& rule);

  // Adds records in one transaction; all are durable when it returns, none when it throws. A trial
  // that is already there keeps its first record. Each record fits the schema, without an infinite
  // value, or is a fault.
  void Append(std::span<const CellRecord> records);

  // Makes trials that ended in a simulator fault pending again, for whom the machine was at fault;
  // what each said is kept as an infrastructure fault. Returns how many.
  std::int64_t RetryFaults();

  // The stored records of a cell, by trial index. Trials beyond those planned stay in the store and
  // are not loaded: an earlier call asked for more of them than the stopping rule of today, and the
  // campaign is the same as if they had not run. Cost: reads all of them into memory, some 500
  // bytes for each drive (truth/value_table.h).
  std::vector<truth::Record> Load(int cell = 0) const;
  // The same with the values of these columns of the schema alone, in this order, and without the
  // sentences that say why trials ended: 96 bytes and the values. Checks the outcomes; the values
  // only where Check has been called.
  std::vector<truth::Record> Load(int cell, const truth::RecordSchema& columns) const;
  // Those with from <= trial < to, planned or not.
  std::vector<truth::Record> Load(int cell, std::int64_t from, std::int64_t to) const;

  // Throws kDamaged where a stored record of the cell, planned or not, does not fit its checksum.
  // Reads all that Load(cell) reads, and keeps nothing.
  void Check(int cell) const;

  // Every stored trial, planned or not, without its values, by cell and trial: 24 bytes for each.
  // Throws kDamaged also where trials are missing, foreign, or were never planned.
  std::vector<FinishedTrial> Finished() const;

  // Something that kept a trial from its result. Durable when it returns.
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
  Checksums checksums_;
  std::vector<std::int64_t> most_planned_;  // ever, by cell
};

// Whether the store in the folder keeps checksums, by its version alone; true also where there is
// no store that can be read, which is for whoever reads it to say.
bool HasChecksums(const std::filesystem::path& folder);

// The records 0, 1, 2, ... up to the first trial that is missing: what rates may be computed from
// (PrefixCounter). `records` by trial index.
std::span<const truth::Record> ContiguousPrefix(std::span<const truth::Record> records);

}  // namespace rockyard::batch
