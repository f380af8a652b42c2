// Hazard studies through the executor: the hash does not depend on threads, order or interruption.
#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "batch/executor.h"
#include "batch/trial_hash.h"
#include "core/test_folder.h"
#include "experiments/make_experiment.h"
#include "fake_experiment.h"
#include "scenario/shipped.h"

namespace rockyard::batch {
namespace {

constexpr std::int64_t kRuns = 24;
const std::atomic<bool> kNeverStop = false;

CampaignIdentity IdentityOf(const experiments::Experiment& experiment, std::uint64_t seed) {
  CampaignIdentity identity = FakeIdentity(seed);
  identity.schema = experiment.schema();
  return identity;
}

BatchOptions Options(int threads, Order order) {
  BatchOptions options;
  options.threads = threads;
  options.order = order;
  return options;
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
    const std::string expected = HashOf(*experiment, Options(1, Order::kNatural));
    EXPECT_EQ(HashOf(*experiment, Options(3, Order::kNatural)), expected) << name;
    EXPECT_EQ(HashOf(*experiment, Options(2, Order::kShuffled)), expected) << name;
    EXPECT_NE(HashOf(*experiment, Options(1, Order::kNatural), 2), expected) << name;
  }
}

}  // namespace
}  // namespace rockyard::batch
