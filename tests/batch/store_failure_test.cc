#include <gmock/gmock.h>
#include <sqlite3.h>

#include <fstream>
#include <optional>
#include <string>

#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "core/test_folder.h"
#include "fake_experiment.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

template <typename Action>
std::optional<StoreError> ErrorOf(Action action) {
  try {
    action();
  } catch (const StoreError& error) {
    return error;
  }
  return std::nullopt;
}

// Every message names the file or folder, and says what to do.
void ExpectError(const std::optional<StoreError>& error, StoreProblem problem,
                 const fs::path& path) {
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->problem(), problem) << error->what();
  EXPECT_THAT(error->problems().front().path, HasSubstr(path.string()));
  EXPECT_FALSE(error->problems().front().reason.empty());
  EXPECT_FALSE(error->problems().front().suggestion.empty());
}

std::string ReadFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void WriteFile(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void ReadAll(const ResultStore& store) {
  store.Finished();
  store.Load();
}

class DamagedStore : public testing::Test {
 protected:
  DamagedStore() {
    ResultStore store = ResultStore::Create(folder_.path(), FakeIdentity(), 400);
    AppendRecords(store, FakeRecords(0, 400));
  }

  void ExpectRefused() {
    const auto read = ErrorOf([&] { ReadAll(ResultStore::Read(folder_.path())); });
    ExpectError(read, StoreProblem::kDamaged, StorePath(folder_.path()));
    const auto resume =
        ErrorOf([&] { ReadAll(ResultStore::Resume(folder_.path(), FakeIdentity())); });
    ExpectError(resume, StoreProblem::kDamaged, StorePath(folder_.path()));
  }

  core::TestFolder folder_;
};

TEST_F(DamagedStore, IsFineBefore) {
  EXPECT_EQ(ResultStore::Resume(folder_.path(), FakeIdentity()).Load().size(), 400U);
}

// What lacks memory is not damaged, and nobody is told to set it aside.
TEST_F(DamagedStore, IsFineWithoutMemory) {
  sqlite3_hard_heap_limit64(1);
  const auto error = ErrorOf([&] { ReadAll(ResultStore::Read(folder_.path())); });
  sqlite3_hard_heap_limit64(0);
  ExpectError(error, StoreProblem::kMemory, StorePath(folder_.path()));
  EXPECT_TRUE(IsOfTheMachine(error->problem()));
  EXPECT_THAT(error->problems().front().suggestion, Not(HasSubstr("--force")));
  EXPECT_EQ(ResultStore::Read(folder_.path()).Load().size(), 400U);
}

TEST_F(DamagedStore, NoDatabase) {
  WriteFile(StorePath(folder_.path()), std::string(5000, 'x'));
  ExpectRefused();
}

TEST_F(DamagedStore, Empty) {
  WriteFile(StorePath(folder_.path()), "");
  ExpectRefused();
}

TEST_F(DamagedStore, CutOffAnywhere) {
  const fs::path path = StorePath(folder_.path());
  const std::string whole = ReadFile(path);
  ASSERT_GT(whole.size(), 20000U);
  for (const std::size_t size : {whole.size() / 2, whole.size() - 1000, std::size_t{4096},
                                 std::size_t{100}, std::size_t{10}}) {
    WriteFile(path, whole.substr(0, size));
    SCOPED_TRACE(size);
    ExpectRefused();
  }
}

TEST_F(DamagedStore, OverwrittenPage) {
  const fs::path path = StorePath(folder_.path());
  std::string text = ReadFile(path);
  text.replace(text.size() / 2 / 4096 * 4096, 4096, std::string(4096, '\x7f'));
  WriteFile(path, text);
  ExpectRefused();
}

TEST_F(DamagedStore, AnotherDatabase) {
  const fs::path path = StorePath(folder_.path());
  fs::remove(path);
  SqliteDatabase(path, Access::kCreate).Execute("CREATE TABLE recipes(name)");
  ExpectRefused();
}

TEST_F(DamagedStore, ImpossibleContents) {
  const fs::path path = StorePath(folder_.path());
  const std::string whole = ReadFile(path);
  for (const char* sql :
       {"UPDATE trials SET outcome = 'flew away' WHERE trial = 17",
        "UPDATE trials SET true_distance_m = 'far' WHERE trial = 17",
        "UPDATE trials SET trial = -3 WHERE trial = 17", "UPDATE cells SET planned = 'many'",
        "UPDATE cells SET seed = '-1'", "UPDATE cells SET cell = 7", "DELETE FROM cells",
        "UPDATE trials SET campaign_cell = 3 WHERE trial = 17",
        "UPDATE meta SET value = '2' WHERE key = 'shard_index'",
        "DELETE FROM meta WHERE key = 'design'", "DROP TABLE columns"}) {
    WriteFile(path, whole);
    SqliteDatabase(path, Access::kChange).Execute(sql);
    SCOPED_TRACE(sql);
    ExpectRefused();
  }
}

TEST_F(DamagedStore, NewerVersion) {
  SqliteDatabase(StorePath(folder_.path()), Access::kChange)
      .Execute("UPDATE meta SET value = '99' WHERE key = 'schema_version'");
  ExpectError(ErrorOf([&] { ResultStore::Read(folder_.path()); }), StoreProblem::kMismatch,
              StorePath(folder_.path()));
}

TEST(StoreFailure, NothingToReadAndNothingToOverwrite) {
  const core::TestFolder folder;
  ExpectError(ErrorOf([&] { ResultStore::Read(folder.path()); }), StoreProblem::kMissing,
              StorePath(folder.path()));
  {
    ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 1);
    AppendRecords(store, {FakeRecord(1, 0)});
  }
  ExpectError(ErrorOf([&] { ResultStore::Create(folder.path(), FakeIdentity(), 1); }),
              StoreProblem::kExists, StorePath(folder.path()));
  EXPECT_EQ(ResultStore::Read(folder.path()).Load().size(), 1U);
}

TEST(StoreFailure, AStoreThatHoldsNothingHasNotBegun) {
  const core::TestFolder folder;
  const fs::path path = StorePath(folder.path());
  EXPECT_FALSE(ResultStore::HasBegun(folder.path()));
  WriteFile(path, "");
  EXPECT_FALSE(ResultStore::HasBegun(folder.path()));
  SqliteDatabase(path, Access::kCreate).Execute("PRAGMA user_version=1");
  EXPECT_GT(fs::file_size(path), 0U);
  EXPECT_FALSE(ResultStore::HasBegun(folder.path()));
  WriteFile(path, std::string(5000, 'x'));
  ExpectError(ErrorOf([&] { ResultStore::HasBegun(folder.path()); }), StoreProblem::kDamaged, path);
  fs::remove(path);
  ResultStore::Create(folder.path(), FakeIdentity(), 1);
  EXPECT_TRUE(ResultStore::HasBegun(folder.path()));
}

TEST(StoreFailure, FolderThatTakesNoFiles) {
  // As root permissions do not bind; /proc refuses everybody.
  const auto error = ErrorOf([] { ResultStore::Create("/proc", FakeIdentity(), 1); });
  ExpectError(error, StoreProblem::kUnwritable, "/proc");
}

TEST(StoreFailure, LockedByAnotherProgram) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 2);
  SqliteDatabase other(StorePath(folder.path()), Access::kChange);
  SqliteTransaction transaction(other);
  const auto error = ErrorOf([&] { AppendRecords(store, {FakeRecord(1, 0)}); });
  ExpectError(error, StoreProblem::kInUse, StorePath(folder.path()));
  transaction.Commit();
  AppendRecords(store, {FakeRecord(1, 0)});
  EXPECT_EQ(store.Load().size(), 1U);
}

TEST(ResumeMismatch, NamesEveryDifference) {
  const core::TestFolder folder;
  ResultStore::Create(folder.path(), FakeIdentity(), 2);
  CampaignIdentity wanted = FakeIdentity(5);
  wanted.cells[0].fingerprint = "1234";
  wanted.cells[0].resolved = "{\"name\": \"other\", \"trials\": 99, \"terrain\": {\"k\": 0.013}}";
  wanted.build = "0.2.0 def";
  const auto error = ErrorOf([&] { ResultStore::Resume(folder.path(), wanted); });
  ExpectError(error, StoreProblem::kMismatch, StorePath(folder.path()));
  const std::string text = error->what();
  EXPECT_THAT(text, HasSubstr("terrain.k: is 0.00415 in the stored run and 0.013 now"));
  EXPECT_THAT(text, HasSubstr("seed: is 1 in the stored run and 5 now"));
  EXPECT_THAT(text, HasSubstr("build: is \"0.1.0 abc\" in the stored run and \"0.2.0 def\" now"));
  EXPECT_THAT(text, testing::Not(HasSubstr("trials: ")));
}

// The rows' checksums hold for the text of the scenario that they were stored with.
TEST(ResumeMismatch, KeysInAnotherOrderAreGoneOnWithByTheirOwnVersion) {
  const core::TestFolder folder;
  CampaignIdentity stored = FakeIdentity();
  stored.cells[0].resolved = R"({"course": {}, "sensors": {}})";
  stored.cells[0].fingerprint =
      ResolvedFingerprint(core::ParseJson(stored.cells[0].resolved, "stored"));
  CampaignIdentity wanted = stored;
  wanted.cells[0].resolved = R"({"sensors": {}, "course": {}})";
  wanted.cells[0].fingerprint =
      ResolvedFingerprint(core::ParseJson(wanted.cells[0].resolved, "wanted"));
  ResultStore::Create(folder.path(), stored, 2);
  const auto error =
      ErrorOf([&] { ResultStore::Resume(folder.path(), wanted, BuildPolicy::kAny); });
  ExpectError(error, StoreProblem::kMismatch, StorePath(folder.path()));
  EXPECT_THAT(error->what(), HasSubstr("keys in another order in the stored run than now"));
}

TEST(ResumeMismatch, AnotherBuildOnRequestOnly) {
  const core::TestFolder folder;
  ResultStore::Create(folder.path(), FakeIdentity(), 2);
  CampaignIdentity wanted = FakeIdentity();
  wanted.build = "0.2.0 def";
  ExpectError(ErrorOf([&] { ResultStore::Resume(folder.path(), wanted); }), StoreProblem::kMismatch,
              StorePath(folder.path()));
  const ResultStore store = ResultStore::Resume(folder.path(), wanted, BuildPolicy::kAny);
  EXPECT_THAT(store.Builds(), testing::ElementsAre("0.1.0 abc", "0.2.0 def"));
  // Mixed from now on: the first build alone would not be the whole truth either.
  ExpectError(ErrorOf([&] { ResultStore::Resume(folder.path(), FakeIdentity()); }),
              StoreProblem::kMismatch, StorePath(folder.path()));
}

}  // namespace
}  // namespace rockyard::batch
