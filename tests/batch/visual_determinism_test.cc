// Drives with visual odometry and a check of slip: the hash of their records depends on neither
// threads, order nor shards.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "batch/executor.h"
#include "batch/merge_shards.h"
#include "batch/trial_hash.h"
#include "core/test_folder.h"
#include "experiments/make_experiment.h"
#include "fake_experiment.h"
#include "scenario/shipped.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

const std::atomic<bool> kNeverStop = false;

class VisualDeterminism : public testing::Test {
 protected:
  void Use(std::int64_t drives, const std::vector<std::string>& overrides) {
    const scenario::Scenario scenario = scenario::Shipped("visual_odometry/soft_slope", overrides);
    drives_ = drives;
    experiment_ = experiments::MakeExperiment(scenario.experiment, scenario.drive);
  }

  std::string Run(const std::string& name, const BatchOptions& options, Shard shard = {},
                  std::uint64_t seed = 1) {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path);
    CampaignIdentity identity = FakeIdentity(seed);
    identity.schema = experiment_->schema();
    identity.shard = shard;
    ResultStore store = ResultStore::Create(path, identity, drives_);
    RunBatch(*experiment_, store, options, kNeverStop);
    return TrialHash(store.Load());
  }

  std::string RunShards(int count) {
    std::vector<fs::path> shards;
    for (int index = 1; index <= count; ++index) {
      const std::string name = "shard" + std::to_string(index) + "of" + std::to_string(count);
      Run(name, {.threads = 1}, {index, count});
      shards.push_back(folder_.path() / name);
    }
    const fs::path merged = folder_.path() / ("merged" + std::to_string(count));
    MergeShards(shards, merged);
    return TrialHash(ResultStore::Read(merged).Load());
  }

  core::TestFolder folder_;
  std::int64_t drives_ = 0;
  std::unique_ptr<experiments::Experiment> experiment_;
};

std::string SensorOf(const std::string& navigator) {
  return navigator == "gestalt" ? "stereo" : "light_stripe";
}

TEST_F(VisualDeterminism, SameHashByTheErrorModel) {
  for (const char* navigator : {"pathfinder", "gestalt"}) {
    SCOPED_TRACE(navigator);
    const std::string name = navigator;
    Use(4, {"navigation.navigator=" + name, "sensors.terrain_sensor=" + SensorOf(name),
            "sensors.stereo.columns=64", "sensors.stereo.rows=12",
            "navigation.on_slip.reaction=replan"});
    const std::string expected = Run(name + "one", {.threads = 1});
    EXPECT_EQ(Run(name + "two", {.threads = 2}), expected);
    EXPECT_EQ(Run(name + "four", {.threads = 4, .order = Order::kShuffled}), expected);
    EXPECT_NE(Run(name + "other", {.threads = 1}, {}, 2), expected);
  }
}

TEST_F(VisualDeterminism, SameHashFromShards) {
  Use(8, {"navigation.on_slip.reaction=replan"});
  const std::string expected = Run("whole", {.threads = 1});
  EXPECT_EQ(RunShards(2), expected);
  EXPECT_EQ(RunShards(3), expected);
}

// A metre by small images.
TEST_F(VisualDeterminism, SameHashFromImages) {
  Use(2, {"sensors.visual_odometry.fidelity=image", "sensors.visual_odometry.pyramid_level=0",
          "sensors.visual_odometry.schedule.every_m=0.25", "sensors.stereo.columns=128",
          "sensors.stereo.rows=24", "course.goal_x_m=1.2"});
  const std::string expected = Run("one", {.threads = 1});
  EXPECT_EQ(Run("two", {.threads = 2, .order = Order::kShuffled}), expected);
  EXPECT_EQ(RunShards(2), expected);
  // What is seen is part of the record.
  Use(2, {"sensors.visual_odometry.schedule.every_m=0.25", "course.goal_x_m=1.2"});
  EXPECT_NE(Run("fitted", {.threads = 1}), expected);
}

}  // namespace
}  // namespace rockyard::batch
