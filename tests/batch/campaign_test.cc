// Campaigns of several cells through the executor: accounting, rules, shards, memory of a plan.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "batch/executor.h"
#include "batch/merge_shards.h"
#include "batch/supervisor.h"
#include "batch/trial_hash.h"
#include "core/test_folder.h"
#include "experiments/make_experiment.h"
#include "fake_experiment.h"
#include "scenario/shipped.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

const std::atomic<bool> kNeverStop = false;

CampaignIdentity ThreeCells() {
  CampaignIdentity identity = FakeIdentity();
  identity.cells = {FakeCell(1, "a"), FakeCell(2, "b"), FakeCell(3, "c")};
  return identity;
}

std::vector<CellWork> WorkOf(const experiments::Experiment& experiment, const ResultStore& store) {
  std::vector<CellWork> work;
  for (const CellIdentity& cell : store.identity().cells) work.push_back({&experiment, cell.seed});
  return work;
}

std::string HashOf(const ResultStore& store) {
  std::vector<CellHash> hashes;
  for (int cell = 0; cell < store.cells(); ++cell) {
    hashes.push_back(
        {store.identity().cells[static_cast<std::size_t>(cell)].name, TrialHash(store.Load(cell))});
  }
  return CampaignHash(hashes);
}

BatchOptions RuleOptions(int threads, Order order = Order::kNatural) {
  BatchOptions options;
  options.threads = threads;
  options.order = order;
  options.rule = {.half_width = 0.12, .max_trials = 1000, .block = 25};
  return options;
}

std::string HashUnderRule(const BatchOptions& options, std::int64_t& trials) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), ThreeCells(), 1000);
  store.SetRule(options.rule);
  const FakeExperiment experiment;
  const BatchResult result = RunBatch(WorkOf(experiment, store), store, options, kNeverStop);
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  EXPECT_EQ(result.progress.finished, result.progress.planned);
  trials = result.progress.finished;
  const ResultStore read = ResultStore::Read(folder.path());
  const std::vector<CellState> ends = StoredEnds(read);
  for (int cell = 0; cell < read.cells(); ++cell) {
    const CellState& end = ends[static_cast<std::size_t>(cell)];
    EXPECT_EQ(end.end, CellEnd::kPrecise);
    EXPECT_EQ(end.asked, read.planned(cell));
    EXPECT_EQ(end.asked % 25, 0);
  }
  return HashOf(read);
}

TEST(Campaign, RuleEndsTheSameWhateverThreadsAndOrder) {
  std::int64_t expected_trials = 0;
  const std::string expected = HashUnderRule(RuleOptions(1), expected_trials);
  EXPECT_LT(expected_trials, 3000);
  for (const Order order : {Order::kNatural, Order::kShuffled}) {
    std::int64_t trials = 0;
    EXPECT_EQ(HashUnderRule(RuleOptions(3, order), trials), expected);
    EXPECT_EQ(trials, expected_trials);
  }
}

TEST(Campaign, RuleGoesOnAfterAStop) {
  std::int64_t expected_trials = 0;
  const std::string expected = HashUnderRule(RuleOptions(1), expected_trials);
  const core::TestFolder folder;
  std::atomic<int> started = 0;
  std::atomic<bool> stop = false;
  const FakeExperiment experiment([&](std::uint64_t) { stop = ++started % 40 == 0; });
  ResultStore store = ResultStore::Create(folder.path(), ThreeCells(), 1000);
  BatchResult result;
  int sessions = 0;
  do {
    stop = false;
    result = RunBatch(WorkOf(experiment, store), store, RuleOptions(2), stop);
    ++sessions;
  } while (result.end == BatchEnd::kStopped && sessions < 200);
  EXPECT_GT(sessions, 2);
  EXPECT_EQ(started, expected_trials) << "nothing is run twice, nothing beyond the rule";
  EXPECT_EQ(HashOf(store), expected);
}

// A longer run was killed, which left holes; a rule that is content with less goes on with it: the
// campaign is the one that the rule alone would have made.
TEST(Campaign, RuleOnAStoreWithMoreTrialsAndHoles) {
  std::int64_t expected_trials = 0;
  const std::string expected = HashUnderRule(RuleOptions(1), expected_trials);
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), ThreeCells(), 1000);
  for (int cell = 0; cell < 3; ++cell) {
    std::vector<CellRecord> rows;
    for (std::uint64_t trial = 0; trial < 900; ++trial) {
      const bool hole = (trial >= 10 && trial < 15) || trial == 700;
      if (!hole) rows.push_back({cell, FakeRecord(static_cast<std::uint64_t>(cell) + 1, trial)});
    }
    store.Append(rows);
  }
  const BatchOptions options = RuleOptions(2);
  store.SetRule(options.rule);
  const FakeExperiment experiment;
  const BatchResult result = RunBatch(WorkOf(experiment, store), store, options, kNeverStop);
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  EXPECT_EQ(result.progress.planned, expected_trials);
  EXPECT_EQ(result.progress.finished, expected_trials);
  const ResultStore read = ResultStore::Read(folder.path());
  EXPECT_EQ(HashOf(read), expected);
  for (int cell = 0; cell < 3; ++cell) {
    EXPECT_EQ(static_cast<std::int64_t>(read.Load(cell).size()), read.planned(cell));
  }
  EXPECT_EQ(read.Finished().size(), 3U * 899) << "nothing is deleted; the five holes are run";
}

// One broken cell is no small part of the whole.
TEST(Campaign, FaultsAreJudgedInEachCell) {
  CampaignIdentity identity = FakeIdentity();
  identity.cells.clear();
  for (int i = 0; i < 50; ++i) identity.cells.push_back(FakeCell(1, fmt::format("c{}", i)));
  for (const bool broken : {false, true}) {
    const core::TestFolder folder;
    ResultStore store = ResultStore::Create(folder.path(), identity, 100);
    const FakeExperiment good;
    const FakeExperiment bad([](std::uint64_t trial) {
      if (trial % 4 == 0) throw std::runtime_error("blew up");
    });
    std::vector<CellWork> work = WorkOf(good, store);
    if (broken) work[37].experiment = &bad;
    const BatchResult result = RunBatch(work, store, {.threads = 2}, kNeverStop);
    EXPECT_LT(result.progress.faults, 50) << "less than 1 % of all 5000";
    EXPECT_EQ(result.too_many_faults, broken);
    EXPECT_EQ(result.faulty_cells, broken ? std::vector<int>{37} : std::vector<int>{});
  }
}

// planned = completed + faulted + pending, at every report.
TEST(Campaign, EveryPlannedTrialIsAccountedFor) {
  const core::TestFolder folder;
  const FakeExperiment experiment([](std::uint64_t index) {
    if (index % 10 == 3) throw std::runtime_error("blew up");
  });
  ResultStore store = ResultStore::Create(folder.path(), ThreeCells(), 40);
  const BatchResult result = RunBatch(WorkOf(experiment, store), store,
                                      {.threads = 2, .max_fault_fraction = 1.0}, kNeverStop);
  EXPECT_EQ(result.progress.planned, 120);
  EXPECT_EQ(result.progress.finished, 120);
  EXPECT_EQ(result.progress.faults, 12);
  EXPECT_EQ(result.progress.cells_ended, 3);
  store.AddInfrastructureFault({{2, 5}, "cpu_time_limit", "slow"});
  EXPECT_EQ(store.Finished().size(), 120U) << "failures of the machine are no trials";
  EXPECT_EQ(store.InfrastructureFaults()[0].kind, "cpu_time_limit");
}

TEST(CampaignHash, OfOneCellIsThatOfItsTrials) {
  EXPECT_EQ(CampaignHash(std::vector<CellHash>{{"", "abc"}}), "abc");
  const std::string two = CampaignHash(std::vector<CellHash>{{"a", "x"}, {"b", "y"}});
  EXPECT_NE(two, CampaignHash(std::vector<CellHash>{{"b", "y"}, {"a", "x"}}));
  EXPECT_NE(two, CampaignHash(std::vector<CellHash>{{"a", "x"}, {"c", "y"}}));
}

// Quasi-static drives.
class DriveCampaign : public testing::Test {
 protected:
  static constexpr std::int64_t kDrives = 8;

  DriveCampaign() {
    const scenario::Scenario scenario = scenario::Shipped(
        "pathfinder/nominal", std::vector<std::string>{"rover.fidelity=quasi_static"});
    experiment_ = experiments::MakeExperiment(scenario.experiment, scenario.drive);
    identity_ = FakeIdentity();
    identity_.schema = experiment_->schema();
  }

  std::string Run(const std::string& name, const BatchOptions& options, Shard shard = {}) {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path);
    CampaignIdentity identity = identity_;
    identity.shard = shard;
    ResultStore store = ResultStore::Create(path, identity, kDrives);
    RunBatch(*experiment_, store, options, kNeverStop);
    return HashOf(store);
  }

  core::TestFolder folder_;
  std::unique_ptr<experiments::Experiment> experiment_;
  CampaignIdentity identity_;
};

TEST_F(DriveCampaign, SameHashForThreadsShardsAndOrders) {
  const std::string expected = Run("one", {.threads = 1});
  EXPECT_EQ(Run("two", {.threads = 2}), expected);
  EXPECT_EQ(Run("shuffled", {.threads = 2, .order = Order::kShuffled}), expected);
  std::vector<fs::path> shards;
  for (int index = 1; index <= 4; ++index) {
    const std::string name = "shard" + std::to_string(index);
    EXPECT_NE(Run(name, {.threads = 1}, {index, 4}), expected);
    shards.push_back(folder_.path() / name);
  }
  MergeShards(shards, folder_.path() / "merged");
  EXPECT_EQ(HashOf(ResultStore::Read(folder_.path() / "merged")), expected);
}

}  // namespace
}  // namespace rockyard::batch
