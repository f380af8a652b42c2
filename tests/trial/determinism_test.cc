// A trial is a pure function of (scenario, seed, index).
#include <gmock/gmock.h>

#include <future>

#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using testing::IsEmpty;

constexpr std::uint32_t kTrials = 3;

class DeterminismTest : public testing::Test {
 protected:
  const DriveParams drive_ = Pathfinder("obstacles_0.57", {"referee.time_limit_s=2500"});
  const std::vector<DriveResult> expected_ = RunTrials(drive_, kTrials);
};

TEST_F(DeterminismTest, TraceAndOrderChangeNoBit) {
  for (std::uint32_t i = kTrials; i-- > 0;) {
    const TracedTrial traced = RunTraced(drive_, i);
    EXPECT_THAT(Differences(traced.result, expected_[i]), IsEmpty()) << i;
    EXPECT_FALSE(traced.trace.samples.empty());
  }
}

TEST_F(DeterminismTest, ThreadsAtTheSameTimeChangeNoBit) {
  std::vector<std::future<DriveResult>> results;
  for (std::uint32_t i = 0; i < kTrials; ++i) {
    results.push_back(std::async(std::launch::async, [this, i] {
      return RunTrial(drive_, {1, i});
    }));
  }
  for (std::uint32_t i = 0; i < kTrials; ++i) {
    EXPECT_THAT(Differences(results[i].get(), expected_[i]), IsEmpty()) << i;
  }
}

TEST_F(DeterminismTest, ResolvedScenarioGivesTheSameTrial) {
  scenario::Scenario scenario;
  scenario.drive = drive_;
  const DriveParams resolved = scenario::ParseScenario(scenario::ResolvedJson(scenario)).drive;
  EXPECT_THAT(Differences(RunTrial(resolved, {1, 1}), expected_[1]), IsEmpty());
}

// Could any two trials compare as equal, the tests above would show nothing.
TEST_F(DeterminismTest, OtherIndicesAndSeedsGiveOtherTrials) {
  for (std::uint32_t i = 1; i < kTrials; ++i) {
    EXPECT_THAT(Differences(expected_[0], expected_[i]), testing::Contains("true_distance_m"));
  }
  EXPECT_THAT(Differences(expected_[0], RunTrial(drive_, {2, 0})),
              testing::Contains("true_distance_m"));
}

}  // namespace
}  // namespace rockyard::trial
