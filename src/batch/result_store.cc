#include "batch/result_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "batch/run_folder.h"
#include "batch/scenario_difference.h"
#include "batch/sqlite_database.h"
#include "batch/store_error.h"
#include "core/check.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSchemaVersion = 1;
constexpr int kFixedColumns = 3;  // trial, outcome, detail
constexpr const char* kStartAnew =
    "run again with --force: the file is set aside, not deleted, and the trials are run anew";

std::string Quoted(std::string_view name) {
  std::string quoted(1, '"');
  for (const char c : name) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

[[noreturn]] void FailDamaged(const fs::path& path, const std::string& reason) {
  throw StoreError(StoreProblem::kDamaged, path.string(), reason, kStartAnew);
}

std::string CreateTrialsSql(const truth::RecordSchema& schema) {
  std::string sql =
      "CREATE TABLE trials(trial INTEGER PRIMARY KEY, outcome TEXT NOT NULL, detail TEXT NOT NULL";
  for (const truth::ValueInfo& value : schema) sql += ", " + Quoted(value.name);
  return sql + ")";
}

std::string InsertSql(const truth::RecordSchema& schema) {
  std::string sql = "INSERT OR IGNORE INTO trials VALUES (?, ?, ?";
  for (std::size_t i = 0; i < schema.size(); ++i) sql += ", ?";
  return sql + ")";
}

std::string SelectSql(const truth::RecordSchema& schema) {
  std::string sql = "SELECT trial, outcome, detail";
  for (const truth::ValueInfo& value : schema) sql += ", " + Quoted(value.name);
  return sql + " FROM trials ORDER BY trial";
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

template <typename Integer>
Integer GetNumber(const SqliteDatabase& database, std::string_view key) {
  const std::string text = GetMeta(database, key);
  try {
    std::size_t used = 0;
    const unsigned long long value = std::stoull(text, &used);
    if (used == text.size() && std::in_range<Integer>(value)) return static_cast<Integer>(value);
  } catch (const std::logic_error&) {
    // Reported below, with all that is no number.
  }
  FailDamaged(database.path(), fmt::format("has {} = \"{}\", which is no count", key, text));
}

void WriteNewStore(SqliteDatabase& database, const RunIdentity& identity, std::int64_t planned) {
  SqliteTransaction transaction(database);
  database.Execute("CREATE TABLE meta(key TEXT PRIMARY KEY, value TEXT NOT NULL)");
  database.Execute(
      "CREATE TABLE columns(position INTEGER PRIMARY KEY, name TEXT, unit TEXT, meaning TEXT)");
  database.Execute("CREATE TABLE builds(build TEXT PRIMARY KEY)");
  database.Execute(CreateTrialsSql(identity.schema));
  PutMeta(database, "schema_version", std::to_string(kSchemaVersion));
  PutMeta(database, "scenario", identity.scenario);
  PutMeta(database, "fingerprint", identity.fingerprint);
  PutMeta(database, "resolved_scenario", identity.resolved);
  PutMeta(database, "seed", std::to_string(identity.seed));
  PutMeta(database, "planned", std::to_string(planned));
  database.Prepare("INSERT INTO builds VALUES (?)").Bind(0, identity.build).Step();
  SqliteStatement column = database.Prepare("INSERT INTO columns VALUES (?, ?, ?, ?)");
  for (std::size_t i = 0; i < identity.schema.size(); ++i) {
    const truth::ValueInfo& value = identity.schema[i];
    column.Bind(0, static_cast<std::int64_t>(i)).Bind(1, value.name).Bind(2, value.unit);
    column.Bind(3, value.meaning).Step();
    column.Reset();
  }
  transaction.Commit();
}

void PrepareToWrite(SqliteDatabase& database) {
  database.Execute("PRAGMA journal_mode=WAL");
  database.Execute("PRAGMA synchronous=FULL");
}

truth::TrialOutcome OutcomeOf(const fs::path& path, std::int64_t trial, const std::string& name) {
  for (std::size_t i = 0; i < truth::kTrialOutcomeNames.size(); ++i) {
    if (truth::kTrialOutcomeNames[i] == name) return static_cast<truth::TrialOutcome>(i);
  }
  FailDamaged(path, fmt::format("has the unknown outcome \"{}\" at trial {}", name, trial));
}

std::string ColumnList(const truth::RecordSchema& schema) {
  std::string text;
  for (const truth::ValueInfo& value : schema) text += (text.empty() ? "" : ", ") + value.name;
  return text;
}

// Everything that keeps the stored trials and the new ones from belonging together.
std::vector<core::Problem> Differences(const RunIdentity& stored, const RunIdentity& wanted,
                                       const std::vector<std::string>& builds, BuildPolicy policy) {
  std::vector<core::Problem> problems;
  if (stored.fingerprint != wanted.fingerprint) {
    problems = ScenarioDifferences(stored.resolved, wanted.resolved);
    if (problems.empty()) problems.push_back({"scenario", "has another fingerprint", ""});
  }
  const auto has_seed = [](const core::Problem& problem) { return problem.path == "seed"; };
  if (stored.seed != wanted.seed && std::none_of(problems.begin(), problems.end(), has_seed)) {
    problems.push_back(
        {"seed", fmt::format("is {} in the stored run and {} now", stored.seed, wanted.seed), ""});
  }
  if (ColumnList(stored.schema) != ColumnList(wanted.schema)) {
    problems.push_back({"columns", "of the records differ: the program has changed", ""});
  }
  for (const std::string& build : builds) {
    if (policy == BuildPolicy::kAny || build == wanted.build) continue;
    problems.push_back({"build", fmt::format("was \"{}\", is \"{}\" now", build, wanted.build),
                        "add --force to go on all the same: records may differ in their last bits"
                        " or more"});
  }
  return problems;
}

void CheckIdentity(const fs::path& path, const RunIdentity& stored, const RunIdentity& wanted,
                   const std::vector<std::string>& builds, BuildPolicy policy) {
  std::vector<core::Problem> problems = Differences(stored, wanted, builds, policy);
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

ResultStore ResultStore::Create(const fs::path& folder, const RunIdentity& identity,
                                std::int64_t planned) {
  const fs::path path = StorePath(folder);
  if (HoldsStore(folder)) {
    throw StoreError(StoreProblem::kExists, path.string(), "exists",
                     "go on with it by --resume, set it aside by --force, or choose another "
                     "folder with --out");
  }
  try {
    ResultStore store(path, std::make_unique<SqliteDatabase>(path, Access::kCreate));
    PrepareToWrite(*store.database_);
    WriteNewStore(*store.database_, identity, planned);
    store.identity_ = identity;
    store.planned_ = planned;
    return store;
  } catch (const StoreError&) {
    // What could not even be begun leaves nothing behind that a later run would trip over.
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(path.string() + suffix, ignored);
    throw;
  }
}

ResultStore ResultStore::Resume(const fs::path& folder, const RunIdentity& identity,
                                BuildPolicy policy) {
  ResultStore store = Read(folder);
  CheckIdentity(store.path_, store.identity_, identity, store.Builds(), policy);
  store.database_ = std::make_unique<SqliteDatabase>(store.path_, Access::kChange);
  PrepareToWrite(*store.database_);
  SqliteStatement build = store.database_->Prepare("INSERT OR IGNORE INTO builds VALUES (?)");
  build.Bind(0, identity.build).Step();
  store.identity_ = identity;
  return store;
}

ResultStore ResultStore::Read(const fs::path& folder) {
  const fs::path path = StorePath(folder);
  std::error_code error;
  if (!HoldsStore(folder)) {
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
  store.ReadMeta();
  return store;
}

void ResultStore::ReadMeta() {
  const auto version = GetNumber<std::int64_t>(*database_, "schema_version");
  if (version != kSchemaVersion) {
    throw StoreError(StoreProblem::kMismatch, path_.string(),
                     fmt::format("has version {}, not {}", version, kSchemaVersion),
                     "use the program that made it, or another folder");
  }
  identity_.scenario = GetMeta(*database_, "scenario");
  identity_.fingerprint = GetMeta(*database_, "fingerprint");
  identity_.resolved = GetMeta(*database_, "resolved_scenario");
  identity_.seed = GetNumber<std::uint64_t>(*database_, "seed");
  planned_ = GetNumber<std::int64_t>(*database_, "planned");
  SqliteStatement columns =
      database_->Prepare("SELECT name, unit, meaning FROM columns ORDER BY position");
  while (columns.Step()) {
    identity_.schema.push_back({columns.Text(0), columns.Text(1), columns.Text(2)});
  }
  const std::vector<std::string> builds = Builds();
  if (!builds.empty()) identity_.build = builds.front();
}

std::vector<std::string> ResultStore::Builds() const {
  std::vector<std::string> builds;
  SqliteStatement select = database_->Prepare("SELECT build FROM builds ORDER BY rowid");
  while (select.Step()) builds.push_back(select.Text(0));
  return builds;
}

std::int64_t ResultStore::EndOfTrials() const {
  SqliteStatement select = database_->Prepare("SELECT max(trial) FROM trials");
  return select.Step() && !select.IsNull(0) ? select.Integer(0) + 1 : 0;
}

void ResultStore::SetPlanned(std::int64_t planned) {
  PutMeta(*database_, "planned", std::to_string(planned));
  planned_ = planned;
}

void ResultStore::Append(std::span<const truth::Record> records) {
  if (records.empty()) return;
  SqliteTransaction transaction(*database_);
  SqliteStatement insert = database_->Prepare(InsertSql(identity_.schema));
  for (const truth::Record& record : records) {
    const bool fault = record.outcome == truth::TrialOutcome::kSimulatorFault;
    EXPECT(fault || record.values.size() == identity_.schema.size());
    insert.Bind(0, static_cast<std::int64_t>(record.trial));
    insert.Bind(1, truth::Name(record.outcome)).Bind(2, record.detail);
    for (std::size_t i = 0; i < identity_.schema.size(); ++i) {
      const int parameter = kFixedColumns + static_cast<int>(i);
      if (fault) {
        insert.BindNull(parameter);
      } else {
        insert.Bind(parameter, record.values[i]);
      }
    }
    insert.Step();
    insert.Reset();
  }
  transaction.Commit();
}

std::vector<truth::Record> ResultStore::Load() const {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  std::vector<truth::Record> records;
  SqliteStatement select = database_->Prepare(SelectSql(identity_.schema));
  while (select.Step()) {
    truth::Record record;
    const std::int64_t trial = select.Integer(0);
    if (trial < 0) FailDamaged(path_, fmt::format("has a trial with the index {}", trial));
    record.trial = static_cast<std::uint64_t>(trial);
    record.outcome = OutcomeOf(path_, trial, select.Text(1));
    record.detail = select.Text(2);
    const bool fault = record.outcome == truth::TrialOutcome::kSimulatorFault;
    for (std::size_t i = 0; !fault && i < identity_.schema.size(); ++i) {
      const int column = kFixedColumns + static_cast<int>(i);
      if (!select.IsNull(column) && !select.IsReal(column)) {
        FailDamaged(
            path_, fmt::format("has no number in {} of trial {}", identity_.schema[i].name, trial));
      }
      record.values.push_back(select.IsNull(column) ? kNan : select.Real(column));
    }
    records.push_back(std::move(record));
  }
  return records;
}

std::span<const truth::Record> ContiguousPrefix(std::span<const truth::Record> records) {
  std::size_t length = 0;
  while (length < records.size() && records[length].trial == length) ++length;
  return records.first(length);
}

}  // namespace rockyard::batch
