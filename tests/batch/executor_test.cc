#include "batch/executor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <new>
#include <set>
#include <string>

#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "batch/trial_hash.h"
#include "core/test_folder.h"
#include "experiments/make_experiment.h"
#include "fake_experiment.h"
#include "scenario/shipped.h"

namespace rockyard::batch {
namespace {

using testing::HasSubstr;
using truth::TrialOutcome;

constexpr std::int64_t kTrials = 200;
const std::atomic<bool> kNeverStop = false;

BatchOptions Options(int threads, Order order = Order::kNatural) {
  return {.threads = threads, .order = order, .interval = std::chrono::milliseconds(5)};
}

std::string PlainHash() { return FakeHash(kTrials); }

std::string HashAfter(const BatchOptions& options, std::uint64_t seed = 1) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(seed), kTrials);
  const BatchResult result = RunBatch(FakeExperiment(), store, options, kNeverStop);
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  EXPECT_EQ(result.progress.finished, kTrials);
  return TrialHash(ResultStore::Read(folder.path()).Load());
}

TEST(Executor, SameRecordsWhateverThreadsAndOrder) {
  const std::string expected = PlainHash();
  EXPECT_EQ(HashAfter(Options(1)), expected);
  EXPECT_EQ(HashAfter(Options(2)), expected);
  EXPECT_EQ(HashAfter(Options(5)), expected);
  EXPECT_EQ(HashAfter(Options(1, Order::kShuffled)), expected);
  EXPECT_EQ(HashAfter(Options(2, Order::kShuffled)), expected);
  EXPECT_NE(HashAfter(Options(2), 2), expected);
}

TEST(Executor, ShuffledOrderIsAnotherOrder) {
  std::vector<std::uint64_t> order;
  const FakeExperiment experiment([&](std::uint64_t index) { order.push_back(index); });
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), kTrials);
  RunBatch(experiment, store, Options(1, Order::kShuffled), kNeverStop);
  EXPECT_EQ(std::set(order.begin(), order.end()).size(), static_cast<std::size_t>(kTrials));
  EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
}

TEST(Executor, StopsOnRequestAndGoesOnToTheSameHash) {
  const core::TestFolder folder;
  std::atomic<bool> stop = false;
  std::atomic<int> started = 0;
  const FakeExperiment experiment([&](std::uint64_t) {
    if (++started == 40) stop = true;
  });
  {
    ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), kTrials);
    const BatchResult result = RunBatch(experiment, store, Options(2, Order::kShuffled), stop);
    EXPECT_EQ(result.end, BatchEnd::kStopped);
    // What was in flight is finished and stored.
    EXPECT_EQ(result.progress.finished, started.load());
    EXPECT_EQ(store.Load().size(), static_cast<std::size_t>(started.load()));
    EXPECT_LT(started.load(), kTrials);
  }
  started = 0;
  ResultStore store = ResultStore::Resume(folder.path(), FakeIdentity());
  const auto before = static_cast<std::int64_t>(store.Load().size());
  const BatchResult result = RunBatch(experiment, store, Options(2), kNeverStop);
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  EXPECT_EQ(result.progress.finished_before, before);
  EXPECT_EQ(started.load(), kTrials - before) << "no stored trial is run again";
  EXPECT_EQ(TrialHash(store.Load()), PlainHash());
}

// A watchdog or a user may ask while the last trial ends.
TEST(Executor, ThatIsStoppedInItsLastTrialHasFinished) {
  const core::TestFolder folder;
  std::atomic<bool> stop = false;
  std::atomic<int> started = 0;
  const FakeExperiment experiment([&](std::uint64_t) {
    if (++started == kTrials) stop = true;
  });
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), kTrials);
  EXPECT_EQ(RunBatch(experiment, store, Options(2), stop).end, BatchEnd::kFinished);
  EXPECT_EQ(TrialHash(store.Load()), PlainHash());
}

TEST(Executor, ExtendsARun) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 50);
  RunBatch(FakeExperiment(), store, Options(2), kNeverStop);
  EXPECT_EQ(store.Load().size(), 50U);
  store.SetPlanned(0, kTrials);
  RunBatch(FakeExperiment(), store, Options(2), kNeverStop);
  EXPECT_EQ(TrialHash(store.Load()), PlainHash());
}

// 40 of 200: some throw, one returns a record of the wrong length.
TEST(Executor, CountsFaultsApartAndFailsAboveTheFraction) {
  const core::TestFolder folder;
  const FakeExperiment experiment([](std::uint64_t index) {
    if (index % 5 == 0) throw std::runtime_error("the solver blew up");
  });
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), kTrials);
  const BatchResult result = RunBatch(experiment, store, Options(2), kNeverStop);
  EXPECT_EQ(result.end, BatchEnd::kFinished);
  EXPECT_EQ(result.progress.faults, 40);
  EXPECT_EQ(result.progress.prefix.faults, 40);
  EXPECT_TRUE(result.too_many_faults);
  const truth::Record fault = store.Load()[5];
  EXPECT_EQ(fault.outcome, TrialOutcome::kSimulatorFault);
  EXPECT_EQ(fault.detail, "the solver blew up (seed 1, trial 5)");

  BatchOptions patient = Options(2);
  patient.max_fault_fraction = 0.2;
  EXPECT_FALSE(RunBatch(experiment, store, patient, kNeverStop).too_many_faults)
      << "exactly the fraction is not above it";
}

// No result of the trial: it stays pending, the others are kept, and a later session runs it.
TEST(Executor, AFailureOfTheMachineIsThrownAndNoFault) {
  const core::TestFolder folder;
  const FakeExperiment experiment([](std::uint64_t index) {
    if (index == 60) throw std::bad_alloc();
  });
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), kTrials);
  EXPECT_THROW(RunBatch(experiment, store, Options(2), kNeverStop), std::bad_alloc);
  const std::vector<truth::Record> stored = store.Load();
  EXPECT_GE(stored.size(), 60U);
  EXPECT_LT(stored.size(), static_cast<std::size_t>(kTrials)) << "none is begun after it";
  EXPECT_TRUE(std::none_of(stored.begin(), stored.end(), [](const truth::Record& record) {
    return record.trial == 60 || truth::IsFault(record);
  }));
  RunBatch(FakeExperiment(), store, Options(2), kNeverStop);
  EXPECT_EQ(TrialHash(store.Load()), PlainHash());
}

class ShortRecords final : public experiments::Experiment {
 public:
  const truth::RecordSchema& schema() const override { return schema_; }
  truth::Record Run(std::uint64_t, std::uint64_t index) const override {
    return {index, TrialOutcome::kGoalReached, "", {1.0}};
  }

 private:
  truth::RecordSchema schema_ = FakeSchema();
};

TEST(Executor, ARecordThatDoesNotFitIsAFault) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), kTrials);
  EXPECT_EQ(RunBatch(ShortRecords(), store, Options(2), kNeverStop).progress.faults, kTrials);
  EXPECT_THAT(store.Load()[0].detail, HasSubstr("1 values for 3 columns"));
}

class InfiniteRecords final : public experiments::Experiment {
 public:
  const truth::RecordSchema& schema() const override { return schema_; }
  truth::Record Run(std::uint64_t, std::uint64_t index) const override {
    return {index,
            TrialOutcome::kGoalReached,
            "",
            {1.0, -std::numeric_limits<double>::infinity(), 1.0}};
  }

 private:
  truth::RecordSchema schema_ = FakeSchema();
};

TEST(Executor, AnInfiniteValueIsAFault) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), kTrials);
  EXPECT_EQ(RunBatch(InfiniteRecords(), store, Options(2), kNeverStop).progress.faults, kTrials);
  EXPECT_THAT(store.Load()[0].detail, HasSubstr("sim_time_s is infinite"));
}

TEST(Executor, ReportsByOneThreadAtATimeAndAtTheEnd) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), kTrials);
  const FakeExperiment slow(
      [](std::uint64_t) { std::this_thread::sleep_for(std::chrono::microseconds(300)); });
  std::mutex mutex;
  std::vector<Progress> seen;
  RunBatch(slow, store, Options(2), kNeverStop, [&](const Progress& progress) {
    const std::unique_lock lock(mutex, std::try_to_lock);
    ASSERT_TRUE(lock.owns_lock());
    seen.push_back(progress);
  });
  ASSERT_FALSE(seen.empty());
  EXPECT_EQ(seen.back().finished, kTrials);
  EXPECT_EQ(seen.back().prefix.trials, kTrials);
  for (const Progress& progress : seen) EXPECT_LE(progress.prefix.trials, progress.finished);
}

TEST(Executor, AStoreThatFailsStopsTheRunAndLosesNothingStored) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), FakeIdentity(), 100000);
  // From trial 30 on the store refuses records.
  SqliteDatabase(StorePath(folder.path()), Access::kChange)
      .Execute(
          "CREATE TRIGGER refuse BEFORE INSERT ON trials WHEN NEW.trial >= 30 "
          "BEGIN SELECT RAISE(ABORT, 'refused'); END");
  std::atomic<int> started = 0;
  const FakeExperiment experiment([&](std::uint64_t) {
    ++started;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  const BatchOptions options = Options(2);
  try {
    RunBatch(experiment, store, options, kNeverStop);
    FAIL() << "nothing was thrown";
  } catch (const StoreError& error) {
    EXPECT_THAT(error.what(), HasSubstr("finished trials could not be stored"));
    EXPECT_THAT(error.what(), HasSubstr("results.sqlite"));
  }
  EXPECT_LT(started.load(), 100000) << "no new trials after the failure";
  SqliteDatabase(StorePath(folder.path()), Access::kChange).Execute("DROP TRIGGER refuse");
  store.SetPlanned(0, kTrials);
  RunBatch(FakeExperiment(), store, options, kNeverStop);
  EXPECT_EQ(TrialHash(store.Load()), PlainHash());
}

// Hazard studies through the executor: the hash does not depend on threads, order or interruption.

constexpr std::int64_t kRuns = 24;

CampaignIdentity IdentityOf(const experiments::Experiment& experiment, std::uint64_t seed) {
  CampaignIdentity identity = FakeIdentity(seed);
  identity.schema = experiment.schema();
  return identity;
}

std::string HashOf(const experiments::Experiment& experiment, const BatchOptions& options,
                   std::uint64_t seed = 1) {
  const core::TestFolder folder;
  ResultStore store = ResultStore::Create(folder.path(), IdentityOf(experiment, seed), kRuns);
  RunBatch(experiment, store, options, kNeverStop);
  return TrialHash(store.Load());
}

TEST(HazardDeterminism, SameHashWhateverThreadsAndOrder) {
  for (const char* name : {"detection", "approach", "persistence", "missed", "precision"}) {
    const scenario::Scenario scenario =
        scenario::Shipped(std::string("hazard_detection/") + name,
                          std::vector<std::string>{"hazard_detection.scenes_per_run=5"});
    const auto experiment = experiments::MakeExperiment(scenario.experiment, scenario.drive);
    const std::string expected = HashOf(*experiment, Options(1));
    EXPECT_EQ(HashOf(*experiment, Options(3)), expected) << name;
    EXPECT_EQ(HashOf(*experiment, Options(2, Order::kShuffled)), expected) << name;
    EXPECT_NE(HashOf(*experiment, Options(1), 2), expected) << name;
  }
}

}  // namespace
}  // namespace rockyard::batch
