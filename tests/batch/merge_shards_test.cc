#include "batch/merge_shards.h"

#include <gmock/gmock.h>

#include <atomic>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "batch/executor.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "batch/trial_hash.h"
#include "core/test_folder.h"
#include "fake_experiment.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::int64_t kTrials = 50;
const std::atomic<bool> kNeverStop = false;

CampaignIdentity TwoCells(Shard shard = {}) {
  CampaignIdentity identity = FakeIdentity();
  identity.cells = {FakeCell(1, "a"), FakeCell(2, "b")};
  identity.shard = shard;
  return identity;
}

void RunAll(ResultStore& store) {
  const FakeExperiment experiment;
  std::vector<CellWork> work;
  for (const CellIdentity& cell : store.identity().cells) work.push_back({&experiment, cell.seed});
  RunBatch(work, store, {.threads = 2}, kNeverStop);
}

std::string HashOf(const fs::path& folder) {
  const ResultStore store = ResultStore::Read(folder);
  std::vector<CellHash> hashes;
  for (int cell = 0; cell < store.cells(); ++cell) {
    hashes.push_back(
        {store.identity().cells[static_cast<std::size_t>(cell)].name, TrialHash(store.Load(cell))});
  }
  return CampaignHash(hashes);
}

class MergeTest : public testing::Test {
 protected:
  fs::path MakeShard(int index, int count, const CampaignIdentity& identity = TwoCells(),
                     std::int64_t trials = kTrials) {
    const fs::path path = folder_.path() / ("shard" + std::to_string(made_++));
    fs::create_directories(path);
    CampaignIdentity own = identity;
    own.shard = {index, count};
    ResultStore store = ResultStore::Create(path, own, trials);
    RunAll(store);
    return path;
  }

  std::string ErrorOf(const std::vector<fs::path>& shards, const MergeOptions& options = {}) {
    try {
      MergeShards(shards, Out(), options);
    } catch (const StoreError& error) {
      EXPECT_FALSE(fs::exists(Out())) << "nothing is left behind";
      return error.what();
    }
    return "";
  }

  fs::path Out() const { return folder_.path() / "merged"; }

  core::TestFolder folder_;
  int made_ = 0;
};

TEST_F(MergeTest, GivesTheHashOfOneMachine) {
  const fs::path whole = folder_.path() / "whole";
  fs::create_directories(whole);
  ResultStore store = ResultStore::Create(whole, TwoCells(), kTrials);
  RunAll(store);
  // In any order.
  const std::vector<fs::path> shards = {MakeShard(3, 4), MakeShard(1, 4), MakeShard(4, 4),
                                        MakeShard(2, 4)};
  MergeShards(shards, Out());
  EXPECT_EQ(HashOf(Out()), HashOf(whole));
  const ResultStore merged = ResultStore::Read(Out());
  EXPECT_TRUE(merged.identity().shard.whole());
  EXPECT_EQ(merged.planned(1), kTrials);
  EXPECT_EQ(merged.Finished().size(), 2U * kTrials);
}

TEST_F(MergeTest, KeepsBuildsAndInfrastructureFaults) {
  CampaignIdentity other = TwoCells();
  other.build = "0.2.0 def";
  const fs::path first = MakeShard(1, 2);
  const fs::path second = MakeShard(2, 2, other);
  {
    CampaignIdentity own = other;
    own.shard = {2, 2};
    ResultStore::Resume(second, own).AddInfrastructureFault({{1, 7}, "cpu_time_limit", "slow"});
  }
  const std::vector<fs::path> shards = {first, second};
  EXPECT_THAT(ErrorOf(shards), HasSubstr("0.2.0 def"));
  MergeShards(shards, Out(), {.build = BuildPolicy::kAny});
  const ResultStore merged = ResultStore::Read(Out());
  EXPECT_THAT(merged.Builds(), testing::ElementsAre("0.1.0 abc", "0.2.0 def"));
  ASSERT_EQ(merged.InfrastructureFaults().size(), 1U);
  EXPECT_EQ(merged.InfrastructureFaults()[0].id, (TrialId{1, 7}));
}

// Tasks of a job array may all call merge at their ends: one makes the folder, the others find it.
TEST_F(MergeTest, TwoAtOnceLeaveOneWhole) {
  const std::vector<fs::path> shards = {MakeShard(1, 2), MakeShard(2, 2)};
  for (int round = 0; round < 10; ++round) {
    std::atomic<int> ready = 0;
    std::atomic<int> made = 0;
    const auto merge = [&] {
      for (++ready; ready < 3;) std::this_thread::yield();
      if (MergeShards(shards, Out()) == Merged::kNow) ++made;
    };
    std::thread first(merge);
    std::thread second(merge);
    merge();
    first.join();
    second.join();
    EXPECT_EQ(made, 1);
    ASSERT_TRUE(HoldsStore(Out()));
    EXPECT_EQ(ResultStore::Read(Out()).Finished().size(), 2U * kTrials);
    fs::remove_all(Out());
  }
}

TEST_F(MergeTest, RefusesMissingAndRepeatedShards) {
  EXPECT_THAT(ErrorOf({}), HasSubstr("shards: are none"));
  const fs::path first = MakeShard(1, 3);
  const fs::path third = MakeShard(3, 3);
  EXPECT_THAT(ErrorOf({first, third}), HasSubstr("are missing: 2/3"));
  EXPECT_THAT(ErrorOf({first, MakeShard(1, 3), third}), HasSubstr("shard 1/3, and so does"));
  MergeShards(std::vector<fs::path>{first, third}, Out(), {.partial = true});
  EXPECT_EQ(ResultStore::Read(Out()).Finished().size(), 2U * (17 + 16));
}

TEST_F(MergeTest, RefusesAShardThatLacksTrials) {
  CampaignIdentity identity = TwoCells({2, 2});
  const fs::path begun = folder_.path() / "begun";
  fs::create_directories(begun);
  ResultStore::Create(begun, identity, kTrials);
  EXPECT_THAT(ErrorOf({MakeShard(1, 2), begun}), HasSubstr("has 0 of 50 trials"));
}

// Of two records of one trial nobody knows which is right.
TEST_F(MergeTest, RefusesTrialsOfAnotherShard) {
  const fs::path first = MakeShard(1, 2);
  const fs::path second = MakeShard(2, 2);
  CampaignIdentity own = TwoCells({1, 2});
  const std::vector<CellRecord> foreign = {{1, FakeRecord(9, 7)}, {1, FakeRecord(9, 9)}};
  ResultStore::Resume(first, own).Append(foreign);
  for (const bool partial : {false, true}) {
    const std::string error = ErrorOf({first, second}, {.partial = partial});
    EXPECT_THAT(error, HasSubstr(StorePath(first).string()));
    EXPECT_THAT(error, HasSubstr("cell 1, trial 7, column trial: it is none of shard 1/2"));
  }
}

// A trial beyond those planned does not stand in for one that lacks.
TEST_F(MergeTest, CountsPlannedTrialsAlone) {
  const fs::path begun = folder_.path() / "begun";
  fs::create_directories(begun);
  CampaignIdentity own = FakeIdentity();
  own.shard = {1, 2};
  {
    ResultStore store = ResultStore::Create(begun, own, 8);
    AppendRecords(store, {FakeRecord(1, 0), FakeRecord(1, 4)});
    store.SetPlanned(0, 4);
  }
  EXPECT_THAT(ErrorOf({begun, MakeShard(2, 2, FakeIdentity(), 4)}), HasSubstr("has 1 of 2 trials"));
}

// What `finish` writes appears with the store, and what it throws leaves neither.
TEST_F(MergeTest, TheFolderAppearsWhole) {
  const std::vector<fs::path> shards = {MakeShard(1, 2), MakeShard(2, 2)};
  const fs::path deep = folder_.path() / "x" / "y" / "all";
  const auto fail = [](const fs::path&) { throw std::runtime_error("half way"); };
  EXPECT_THROW(MergeShards(shards, deep, {}, fail), std::runtime_error);
  EXPECT_FALSE(fs::exists(folder_.path() / "x"));
  MergeShards(shards, deep / "", {}, [&](const fs::path& made) {
    EXPECT_FALSE(fs::exists(deep));
    EXPECT_EQ(ResultStore::Read(made).Finished().size(), 2U * kTrials);
    std::ofstream(made / "summary.json") << "{}";
  });
  EXPECT_TRUE(HoldsStore(deep));
  EXPECT_TRUE(fs::exists(deep / "summary.json"));
  EXPECT_EQ(std::distance(fs::directory_iterator(deep.parent_path()), {}), 1);
}

// As where a merge is repeated that was killed when its folder had its name.
TEST_F(MergeTest, WhatItHasMadeBeforeIsLeftAsItIs) {
  const fs::path first = MakeShard(1, 2);
  const fs::path second = MakeShard(2, 2);
  const std::vector<fs::path> shards = {first, second};
  EXPECT_EQ(MergeShards(shards, Out()), Merged::kNow);
  const fs::file_time_type written = fs::last_write_time(StorePath(Out()));
  EXPECT_EQ(MergeShards(std::vector<fs::path>{second, first}, Out()), Merged::kBefore);
  EXPECT_EQ(fs::last_write_time(StorePath(Out())), written);
  EXPECT_EQ(ResultStore::Read(Out()).Finished().size(), 2U * kTrials);
}

// One that holds anything else than the shards is in the way.
TEST_F(MergeTest, WhatAnotherMergeHasMadeIsInTheWay) {
  const fs::path first = MakeShard(1, 2);
  const fs::path second = MakeShard(2, 2);
  const std::vector<fs::path> shards = {first, second};
  const auto is_in_the_way = [&](const std::vector<fs::path>& others, const MergeOptions& options) {
    try {
      MergeShards(others, Out(), options);
    } catch (const StoreError& error) {
      return error.problem() == StoreProblem::kExists;
    }
    return false;
  };
  // Trials of the one and of the other shard alone, of another campaign, and more of them.
  MergeShards(std::vector<fs::path>{first}, Out(), {.partial = true});
  EXPECT_TRUE(is_in_the_way(shards, {}));
  EXPECT_TRUE(is_in_the_way({second}, {.partial = true}));
  fs::remove_all(Out());
  MergeShards(shards, Out());
  EXPECT_TRUE(is_in_the_way({first}, {.partial = true}));
  CampaignIdentity other = TwoCells();
  other.cells[1] = FakeCell(3, "b");
  EXPECT_TRUE(is_in_the_way({MakeShard(1, 2, other), MakeShard(2, 2, other)}, {}));
  EXPECT_TRUE(
      is_in_the_way({MakeShard(1, 2, TwoCells(), 60), MakeShard(2, 2, TwoCells(), 60)}, {}));
}

TEST_F(MergeTest, RemovesWhatAKilledOneLeft) {
  const std::vector<fs::path> shards = {MakeShard(1, 2), MakeShard(2, 2)};
  const fs::path left = Out().string() + ".tmp-0123456789abcdef";
  fs::create_directories(left / "inside");
  const fs::path own = Out().string() + ".tmp-mine";
  fs::create_directories(own);
  MergeShards(shards, Out());
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(own));
}

TEST_F(MergeTest, RefusesShardsOfDifferentCampaigns) {
  CampaignIdentity other = TwoCells();
  other.cells[1] = FakeCell(3, "b");
  const std::string seeds = ErrorOf({MakeShard(1, 2), MakeShard(2, 2, other)});
  EXPECT_THAT(seeds, HasSubstr("does not go with"));
  EXPECT_THAT(seeds, HasSubstr("cell b: seed: is 3 there and 2 in the first shard"));
  EXPECT_THAT(ErrorOf({MakeShard(1, 2), MakeShard(2, 3)}),
              HasSubstr("are 3 there and 2 in the first shard"));
  EXPECT_THAT(ErrorOf({MakeShard(1, 2), MakeShard(2, 2, TwoCells(), 60)}),
              HasSubstr("planned are 60 there and 50"));
  other = FakeIdentity();
  EXPECT_THAT(ErrorOf({MakeShard(1, 2), MakeShard(2, 2, other)}),
              HasSubstr("cells: are 1 there and 2"));
}

TEST_F(MergeTest, RefusesWhatIsNoShardAndAFolderThatExists) {
  const fs::path whole = MakeShard(1, 1);
  EXPECT_THAT(ErrorOf({whole}), HasSubstr("holds a whole campaign"));
  EXPECT_THAT(ErrorOf({folder_.path() / "nowhere"}), HasSubstr("does not exist"));
  fs::create_directories(Out());
  try {
    MergeShards(std::vector<fs::path>{MakeShard(1, 2), MakeShard(2, 2)}, Out());
    FAIL() << "nothing was thrown";
  } catch (const StoreError& error) {
    EXPECT_EQ(error.problem(), StoreProblem::kExists);
  }
  EXPECT_TRUE(fs::is_empty(Out()));
}

}  // namespace
}  // namespace rockyard::batch
