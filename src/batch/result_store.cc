#include "batch/result_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "batch/store_rows.h"
#include "batch/store_tables.h"
#include "core/check.h"
#include "core/files.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

// Writes a new store under another name, and renames it: either there is no store, or one with a
// head.
void WriteNew(const fs::path& path, const StoreHead& head) {
  try {
    core::TemporaryFile file(path);
    file.Close();
    {
      SqliteDatabase database(file.path(), Access::kCreate, path);
      // A file that is half made is thrown away: there is nothing to roll back.
      database.Execute("PRAGMA journal_mode=OFF");
      database.Execute("PRAGMA synchronous=FULL");
      WriteStoreHead(database, head);
    }
    file.Commit();
  } catch (const std::system_error& error) {
    FailSystem(path, "cannot be made", error.code().value());
  }
}

// Switches to the write-ahead log. Waits for whoever reads or writes the file with another tool, as
// long as a commit does (kBusyTimeoutMs in sqlite_open.cc): SQLite itself does not wait here.
void BeginLog(SqliteDatabase& database) {
  constexpr int kAttempts = 40;
  constexpr std::chrono::milliseconds kPause{50};
  for (int attempt = 1;; ++attempt) {
    try {
      return database.Execute("PRAGMA journal_mode=WAL");
    } catch (const StoreError& error) {
      if (error.problem() != StoreProblem::kInUse || attempt == kAttempts) throw;
    }
    std::this_thread::sleep_for(kPause);
  }
}

// Prepares a connection that writes. The last statement makes the log, from which readers know that
// somebody writes.
void PrepareToWrite(SqliteDatabase& database) {
  BeginLog(database);
  database.Execute("PRAGMA synchronous=FULL");
  database.Execute("SELECT count(*) FROM sqlite_master");
}

// Refuses views, triggers and virtual tables: they compute values where they are read, or change
// them where they are written, and no rockyard makes them.
void RequireTablesAlone(const SqliteDatabase& database, const fs::path& path) {
  SqliteStatement others = database.Prepare(
      "SELECT type, name FROM sqlite_master WHERE type IN ('view', 'trigger') OR "
      "sql LIKE 'CREATE VIRTUAL%' LIMIT 1");
  if (others.Step()) {
    FailDamaged(path, fmt::format("holds what no rockyard has made: the {} {}", others.Text(0),
                                  others.Text(1)));
  }
}

void CheckIdentity(const fs::path& path, const CampaignIdentity& stored,
                   const CampaignIdentity& wanted, const std::vector<std::string>& builds,
                   BuildPolicy policy) {
  std::vector<core::Problem> problems = CampaignDifferences(stored, wanted, builds, policy);
  if (stored.shard != wanted.shard) {
    problems.push_back({"shard",
                        fmt::format("is {}/{} in the stored run and {}/{} now", stored.shard.index,
                                    stored.shard.count, wanted.shard.index, wanted.shard.count),
                        "give every shard a folder of its own"});
  }
  if (problems.empty()) return;
  problems.insert(problems.begin(),
                  {path.string(), "was made by another run than the one to go on with",
                   "choose another folder with --out, or start anew with --force and without "
                   "--resume (the store is set aside, not deleted)"});
  throw StoreError(StoreProblem::kMismatch, std::move(problems));
}

}  // namespace

ResultStore::ResultStore(fs::path path, std::unique_ptr<SqliteDatabase> database)
    : path_(std::move(path)), database_(std::move(database)) {}
ResultStore::ResultStore(ResultStore&&) noexcept = default;
ResultStore& ResultStore::operator=(ResultStore&&) noexcept = default;
ResultStore::~ResultStore() = default;

ResultStore ResultStore::Create(const fs::path& folder, const CampaignIdentity& identity,
                                const std::vector<std::int64_t>& planned) {
  EXPECT(!identity.cells.empty() && planned.size() == identity.cells.size());
  const fs::path path = StorePath(folder);
  if (HoldsStore(folder)) {
    throw StoreError(StoreProblem::kExists, path.string(), "exists",
                     "go on with it by --resume, set it aside by --force, or choose another "
                     "folder with --out");
  }
  if (HoldsLog(folder)) SetStoreAside(folder);  // of a store that is gone: not of this one
  try {
    WriteNew(path, {identity, planned, std::nullopt});
    ResultStore store(path, std::make_unique<SqliteDatabase>(path, Access::kChange));
    PrepareToWrite(*store.database_);
    store.identity_ = identity;
    store.planned_ = planned;
    store.most_planned_ = planned;
    return store;
  } catch (const StoreError&) {
    // A store that could not even be begun leaves nothing behind that a later run would trip over.
    // The suffixes are those of run_folder.cc (kLogs, kLogIndex).
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-journal", "-shm"}) {
      fs::remove(path.string() + suffix, ignored);
    }
    throw;
  }
}

ResultStore ResultStore::Create(const fs::path& folder, const CampaignIdentity& identity,
                                std::int64_t planned) {
  return Create(folder, identity, std::vector<std::int64_t>(identity.cells.size(), planned));
}

bool ResultStore::HasBegun(const fs::path& folder) {
  std::error_code error;
  const fs::path path = StorePath(folder);
  if (!HoldsStore(folder)) return false;
  if (fs::is_regular_file(path, error) && fs::file_size(path, error) == 0) return false;
  const SqliteDatabase database(path, Access::kRead);
  SqliteStatement tables = database.Prepare("SELECT count(*) FROM sqlite_master");
  return tables.Step() && tables.Integer(0) > 0;
}

void ResultStore::RequireSame(const fs::path& folder, const CampaignIdentity& identity,
                              BuildPolicy policy) {
  const ResultStore store = Read(folder);
  CheckIdentity(store.path_, store.identity_, identity, store.Builds(), policy);
}

ResultStore ResultStore::Resume(const fs::path& folder, const CampaignIdentity& identity,
                                BuildPolicy policy) {
  ResultStore store = Read(folder);
  CheckIdentity(store.path_, store.identity_, identity, store.Builds(), policy);
  for (int cell = 0; cell < store.cells(); ++cell) store.Check(cell);
  static_cast<void>(store.InfrastructureFaults());
  store.database_ = std::make_unique<SqliteDatabase>(store.path_, Access::kChange);
  PrepareToWrite(*store.database_);
  store.AddBuild(identity.build);
  store.identity_ = identity;
  return store;
}

ResultStore ResultStore::Read(const fs::path& folder) {
  const fs::path path = StorePath(folder);
  std::error_code error;
  if (!fs::exists(path, error)) {
    // A folder that may not be entered may hold a store all the same.
    if (error) FailSystem(path, "cannot be opened", error.value());
    throw StoreError(StoreProblem::kMissing, path.string(), "does not exist",
                     "name the folder of a run, as `rockyard run` prints it");
  }
  if (fs::is_regular_file(path, error) && fs::file_size(path, error) == 0) {
    FailDamaged(path, "is empty");
  }
  ResultStore store(path, std::make_unique<SqliteDatabase>(path, Access::kRead));
  if (const std::optional<std::string> damage = store.database_->Damage()) {
    FailDamaged(path, "is damaged: " + *damage);
  }
  RequireTablesAlone(*store.database_, path);
  StoreHead head = ReadStoreHead(*store.database_);
  store.identity_ = std::move(head.identity);
  store.planned_ = std::move(head.planned);
  store.rule_ = head.rule;
  store.most_planned_ = std::move(head.most_planned);
  return store;
}

TrialTable ResultStore::Trials() const { return {identity_, most_planned_}; }

std::vector<std::string> ResultStore::Builds() const {
  const SqliteSnapshot snapshot(*database_);
  return ReadBuilds(*database_);
}

void ResultStore::AddBuild(std::string_view build) {
  SqliteTransaction transaction(*database_);
  batch::AddBuild(*database_, build);
  transaction.Commit();
}

void ResultStore::SetPlanned(int cell, std::int64_t planned) {
  SqliteTransaction transaction(*database_);
  WritePlanned(*database_, cell, planned);
  transaction.Commit();
  planned_.at(static_cast<std::size_t>(cell)) = planned;
  std::int64_t& most = most_planned_.at(static_cast<std::size_t>(cell));
  most = std::max(most, planned);
}

void ResultStore::SetRule(const std::optional<StoppingRule>& rule) {
  SqliteTransaction transaction(*database_);
  WriteRule(*database_, rule);
  transaction.Commit();
  rule_ = rule;
}

void ResultStore::Append(std::span<const CellRecord> records) {
  if (!records.empty()) InsertRecords(*database_, Trials(), records);
}

std::int64_t ResultStore::RetryFaults() { return SetSimulatorFaultsAside(*database_); }

std::vector<truth::Record> ResultStore::Load(int cell) const {
  return Load(cell, 0, planned(cell));
}

std::vector<truth::Record> ResultStore::Load(int cell, const truth::RecordSchema& columns) const {
  EXPECT(cell >= 0 && cell < cells());
  return SelectColumns(*database_, Trials(), columns,
                       {.cell = cell, .from = 0, .to = planned(cell)});
}

std::vector<truth::Record> ResultStore::Load(int cell, std::int64_t from, std::int64_t to) const {
  EXPECT(cell >= 0 && cell < cells());
  return SelectRecords(*database_, Trials(), {.cell = cell, .from = from, .to = to});
}

void ResultStore::Check(int cell) const {
  EXPECT(cell >= 0 && cell < cells());
  CheckRecords(*database_, Trials(), {.cell = cell, .from = 0, .to = kMostTrials});
}

std::vector<FinishedTrial> ResultStore::Finished() const {
  return SelectFinished(*database_, Trials());
}

void ResultStore::AddInfrastructureFault(const InfrastructureFault& fault) {
  SqliteTransaction transaction(*database_);
  InsertFault(*database_, fault);
  transaction.Commit();
}

std::vector<InfrastructureFault> ResultStore::InfrastructureFaults() const {
  const SqliteSnapshot snapshot(*database_);
  return ReadFaults(*database_, cells());
}

std::span<const truth::Record> ContiguousPrefix(std::span<const truth::Record> records) {
  std::size_t length = 0;
  while (length < records.size() && records[length].trial == length) ++length;
  return records.first(length);
}

}  // namespace rockyard::batch
