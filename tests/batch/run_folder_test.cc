#include "batch/run_folder.h"

#include <gmock/gmock.h>

#include <fstream>

#include "batch/campaign_differences.h"
#include "batch/result_store.h"
#include "batch/sqlite_database.h"
#include "core/test_folder.h"
#include "fake_experiment.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

TEST(FolderClaim, IsExclusiveAndEnds) {
  const core::TestFolder folder;
  {
    const FolderClaim claim(folder.path());
    try {
      const FolderClaim second(folder.path());
      FAIL() << "two claims on one folder";
    } catch (const StoreError& error) {
      EXPECT_EQ(error.problem(), StoreProblem::kInUse);
      EXPECT_EQ(error.problems().front().path, folder.path().string());
    }
  }
  EXPECT_NO_THROW(FolderClaim(folder.path()));
  EXPECT_TRUE(fs::is_empty(folder.path())) << "a claim leaves nothing behind";
}

TEST(FolderClaim, MakesFoldersAndSaysWhyNot) {
  const core::TestFolder folder;
  { const FolderClaim claim(folder.path() / "a" / "b"); }
  EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
  std::ofstream(folder.path() / "file") << "x";
  for (const fs::path& path : {folder.path() / "file", folder.path() / "file" / "below",
                               fs::path("/proc/rockyard"), fs::path("/proc")}) {
    try {
      const FolderClaim claim(path);
      FAIL() << path;
    } catch (const StoreError& error) {
      EXPECT_EQ(error.problem(), StoreProblem::kUnwritable) << path;
    }
  }
}

TEST(FolderClaim, LeavesNoPartOfAPathThatCannotBeMade) {
  const core::TestFolder folder;
  const fs::path too_long = folder.path() / "a" / "b" / std::string(300, 'x');
  EXPECT_THROW(FolderClaim{too_long}, StoreError);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  const FolderClaim claim(folder.path() / "a" / "b");
  EXPECT_THAT(claim.made(), testing::ElementsAre(folder.path() / "a" / "b", folder.path() / "a"));
}

TEST(FolderClaim, RemovesWhatKilledRunsLeftOfTheirStores) {
  const core::TestFolder folder;
  const std::string left = StorePath(folder.path()).string() + ".tmp-0123456789abcdef";
  for (const char* suffix : {"", "-journal"}) std::ofstream(left + suffix) << "x";
  EXPECT_TRUE(HoldsNoRunYet(folder.path()));
  const FolderClaim claim(folder.path());
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(HoldsNoRunYet, OnlyWhereEverythingIsALeftover) {
  const core::TestFolder folder;
  EXPECT_TRUE(HoldsNoRunYet(folder.path()));
  EXPECT_FALSE(HoldsNoRunYet(folder.path() / "nowhere"));
  std::ofstream(folder.path() / "results.sqlite-journal") << "x";
  EXPECT_TRUE(HoldsNoRunYet(folder.path()));
  std::ofstream(folder.path() / "letter.txt") << "x";
  EXPECT_FALSE(HoldsNoRunYet(folder.path()));
  fs::remove(folder.path() / "letter.txt");
  ResultStore::Create(folder.path(), FakeIdentity(), 1);
  EXPECT_FALSE(HoldsNoRunYet(folder.path()));
}

TEST(SetStoreAside, TakesTheJournalWithIt) {
  const core::TestFolder folder;
  ResultStore::Create(folder.path(), FakeIdentity(), 1);
  std::ofstream(StorePath(folder.path()).string() + "-journal") << "hot";
  const fs::path aside = SetStoreAside(folder.path());
  EXPECT_TRUE(fs::exists(aside.string() + "-journal"));
  EXPECT_FALSE(fs::exists(StorePath(folder.path()).string() + "-journal"));
}

// SQLite would take it for the log of the new store.
TEST(SetStoreAside, ALogWithoutAStoreIsNotOfTheNextStoreNorOfTheLast) {
  const core::TestFolder folder;
  ResultStore::Create(folder.path(), FakeIdentity(), 1);
  const fs::path first = SetStoreAside(folder.path());
  std::ofstream(StorePath(folder.path()).string() + "-wal") << "lost";
  { const ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 3); }
  EXPECT_EQ(ResultStore::Read(folder.path()).planned(), 3);
  EXPECT_FALSE(fs::exists(first.string() + "-wal"));
  EXPECT_TRUE(fs::exists(folder.path() / "results.old-2.sqlite-wal"));
  EXPECT_EQ(SetStoreAside(folder.path()), folder.path() / "results.old-3.sqlite");
}

TEST(SetStoreAside, KeepsEveryTrial) {
  const core::TestFolder folder;
  std::vector<fs::path> kept;
  for (int generation = 0; generation < 3; ++generation) {
    ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 5);
    for (int i = 0; i <= generation; ++i) {
      AppendRecords(store, {FakeRecord(1, static_cast<std::uint64_t>(i))});
    }
    // The store is still open, so that its last trials are in the log alone.
    kept.push_back(SetStoreAside(folder.path()));
    EXPECT_FALSE(HoldsStore(folder.path()));
  }
  for (std::size_t generation = 0; generation < kept.size(); ++generation) {
    const core::TestFolder restored;
    for (const char* suffix : {"", "-wal"}) {
      if (!fs::exists(kept[generation].string() + suffix)) continue;
      fs::copy(kept[generation].string() + suffix, StorePath(restored.path()).string() + suffix);
    }
    EXPECT_EQ(ResultStore::Read(restored.path()).Load().size(), generation + 1);
  }
}

TEST(FindRuns, TakesARunOrAFolderOfRuns) {
  const core::TestFolder folder;
  EXPECT_THROW(FindRuns(folder.path()), StoreError);
  EXPECT_THROW(FindRuns(folder.path() / "nowhere"), StoreError);
  for (const char* name : {"b", "a"}) {
    fs::create_directories(folder.path() / name);
    ResultStore::Create(folder.path() / name, FakeIdentity(), 1);
  }
  fs::create_directories(folder.path() / "empty");
  EXPECT_THAT(FindRuns(folder.path()),
              testing::ElementsAre(folder.path() / "a", folder.path() / "b"));
  EXPECT_THAT(FindRuns(folder.path() / "a"), testing::ElementsAre(folder.path() / "a"));
}

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> Paths(std::string_view stored, std::string_view wanted) {
  std::vector<std::string> paths;
  for (const core::Problem& problem : ScenarioDifferences(stored, wanted)) {
    paths.push_back(problem.path);
  }
  return paths;
}

TEST(ScenarioDifferences, NamesThePathsThatDiffer) {
  EXPECT_THAT(Paths(R"({"a": {"b": 1, "c": [1, 2], "d": "x"}, "e": true})",
                    R"({"a": {"b": 2, "c": [1, 3], "d": "x"}, "f": true})"),
              ElementsAre("a.b", "a.c", "e", "f"));
}

TEST(ScenarioDifferences, LeavesOutWhatNoRecordDependsOn) {
  EXPECT_THAT(Paths(R"({"name": "a", "description": "b", "trials": 1})",
                    R"({"name": "c", "description": "d", "trials": 2})"),
              IsEmpty());
  // Only at the top: a rock type may have a name that matters.
  EXPECT_THAT(Paths(R"({"rock": {"name": "a"}})", R"({"rock": {"name": "b"}})"),
              ElementsAre("rock.name"));
}

TEST(ScenarioDifferences, SeesTheLastBitAndEndsAtTheLimit) {
  EXPECT_THAT(Paths(R"({"a": 0.1})", R"({"a": 0.10000000000000002})"), ElementsAre("a"));
  const auto few = ScenarioDifferences(R"({"a": 1, "b": 1, "c": 1})", R"({})", 2);
  ASSERT_EQ(few.size(), 3U);
  EXPECT_EQ(few.back().reason, "differs in 1 more places");
}

TEST(ScenarioDifferences, TextThatIsNoJson) {
  EXPECT_EQ(ScenarioDifferences("{", "{}").size(), 1U);
}

}  // namespace
}  // namespace rockyard::batch
