// The store of one run: every finished trial, durable, in one SQLite file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "truth/record.h"

namespace rockyard::batch {

// What decides the records of a run. Plain texts, so that the store knows no scenario.
struct RunIdentity {
  std::string scenario;     // name
  std::string fingerprint;  // of the resolved scenario
  std::string resolved;     // JSON of every effective value
  std::uint64_t seed = 1;
  std::string build;  // program, compiler, flags and CPU level: what libm and the code depend on
  truth::RecordSchema schema;
};

// Whether a run may go on with another build than the one that began it. Another scenario or seed
// is never accepted: the trials would not belong together.
enum class BuildPolicy { kSame, kAny };

class SqliteDatabase;

// The file `results.sqlite` in a run folder. Tables:
//   meta(key, value)                        schema version, planned trials, and the RunIdentity
//   columns(position, name, unit, meaning)  the record schema
//   builds(build)                           every build that wrote trials
//   trials(trial, outcome, detail, one column per value)
// Value columns have no declared type, because a REAL column would lose the sign of zero; doubles
// keep their bits, and NaN is NULL. A simulator fault has NULL everywhere.
//
// Durability: write-ahead log with a synchronous commit: what Append has returned for survives a
// killed process and a power cut (as far as the disk keeps its promises). Every failure is a
// StoreError. One thread at a time; one writer per folder (hold a FolderClaim).
class ResultStore {
 public:
  // Makes the store; there must be none. kExists, kUnwritable, kFull.
  static ResultStore Create(const std::filesystem::path& folder, const RunIdentity& identity,
                            std::int64_t planned);

  // Opens the store to go on. kMissing, kDamaged, and kMismatch with every difference: the JSON
  // paths of the scenario, the seed, the build, the columns.
  static ResultStore Resume(const std::filesystem::path& folder, const RunIdentity& identity,
                            BuildPolicy policy = BuildPolicy::kSame);

  // Opens the store to read, also while a run writes it. kMissing, kDamaged.
  static ResultStore Read(const std::filesystem::path& folder);

  ResultStore(ResultStore&&) noexcept;
  ResultStore& operator=(ResultStore&&) noexcept;
  ~ResultStore();

  const RunIdentity& identity() const { return identity_; }
  const std::filesystem::path& path() const { return path_; }
  std::int64_t planned() const { return planned_; }
  std::vector<std::string> Builds() const;
  // One more than the largest stored trial index; 0 where there is none.
  std::int64_t EndOfTrials() const;

  void SetPlanned(std::int64_t planned);

  // Adds records in one transaction; all are durable when it returns, none when it throws. A trial
  // that is already there keeps its first record. Each record fits the schema or is a fault.
  void Append(std::span<const truth::Record> records);

  // Every stored record, by trial index. Cost: reads the whole file.
  std::vector<truth::Record> Load() const;

 private:
  ResultStore(std::filesystem::path path, std::unique_ptr<SqliteDatabase> database);
  void ReadMeta();

  std::filesystem::path path_;
  std::unique_ptr<SqliteDatabase> database_;
  RunIdentity identity_;
  std::int64_t planned_ = 0;
};

// The records 0, 1, 2, ... up to the first trial that is missing: what rates may be computed from
// (prefix_counter.h). `records` by trial index.
std::span<const truth::Record> ContiguousPrefix(std::span<const truth::Record> records);

}  // namespace rockyard::batch
