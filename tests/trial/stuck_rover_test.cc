// What becomes of a rover that is stuck: by the referee's verdict.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "trial/pathfinder_trials.h"

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

constexpr double kStall_W = 3.77 + 0.80 + 8.28;  // Matthies 1995, table 1

// Drives against a wall, on ground that is too hard for its steered wheels to push it off.
DriveParams AtAWall(const Overrides& overrides) {
  Overrides all{"terrain.arena.kind=walled", "terrain.ground.soil.preset=hard_ground",
                "course.start_y_m=1.2", "course.start_heading_deg=90"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return Pathfinder("level_sand", all);
}

TracedTrial DriveAtAWall(const std::string& stuck_rover) {
  return RunTraced(AtAWall({"referee.stuck_rover=" + stuck_rover}), 0);
}

class StuckRoverTest : public testing::Test {
 protected:
  const TracedTrial ended_ = DriveAtAWall("end");
  const TracedTrial ran_on_ = DriveAtAWall("run_on");
  const truth::DriveRecord& end() const { return ended_.result.record; }
  const truth::DriveRecord& run_on() const { return ran_on_.result.record; }
};

TEST_F(StuckRoverTest, ItsRunEndsAtTheVerdictByDefault) {
  EXPECT_EQ(RefereeParams{}.stuck_rover, StuckRover::kEnd);
  ASSERT_EQ(ended_.result.outcome, TrialOutcome::kJammed);
  const RefereeParams referee;
  EXPECT_LT(end().sim_time_s, 60.0 + 2.0 * referee.stall_window_s);
  EXPECT_EQ(end().active_time_s, end().sim_time_s);
  EXPECT_EQ(end().active_energy_wh, end().energy_wh);
  EXPECT_NEAR(end().net_rate_m_s, end().true_distance_m / end().sim_time_s, 1e-12);
}

TEST_F(StuckRoverTest, WhatItWouldStillTakeIsTheRestOfTheBatteries) {
  const double battery_wh = AtAWall({}).energy.battery_wh;
  EXPECT_NEAR(end().stall_energy_wh, battery_wh - end().energy_wh, 1e-9);
  EXPECT_NEAR(end().stall_time_s, end().stall_energy_wh * 3600.0 / kStall_W, 1e-6);
  EXPECT_EQ(run_on().stall_time_s, end().stall_time_s);
  EXPECT_EQ(run_on().stall_energy_wh, end().stall_energy_wh);
}

TEST_F(StuckRoverTest, RunningOnAddsThatAndNothingElse) {
  EXPECT_THAT(Differences(ended_.result, ran_on_.result),
              testing::IsSubsetOf({"sim_time_s", "energy_wh", "net_rate_m_s",
                                   "single_scan_rate_m_s", "active_time_s", "active_energy_wh"}));
  // The same up to what adding and taking away the stall rounds.
  EXPECT_NEAR(run_on().active_time_s, end().active_time_s, 1e-9);
  EXPECT_NEAR(run_on().active_energy_wh, end().active_energy_wh, 1e-9);
  EXPECT_EQ(run_on().sim_time_s, end().sim_time_s + end().stall_time_s);
  EXPECT_NEAR(run_on().energy_wh, AtAWall({}).energy.battery_wh, 1e-9);
  EXPECT_NEAR(run_on().net_rate_m_s, run_on().true_distance_m / run_on().sim_time_s, 1e-12);
}

TEST_F(StuckRoverTest, TracesEndWithTheirRecords) {
  EXPECT_EQ(ended_.trace.now_s(), end().sim_time_s);
  EXPECT_EQ(ended_.trace.rests.back().sample.activity, "");
  EXPECT_EQ(ended_.trace.events.back().kind, "end");
  EXPECT_EQ(ended_.trace.events.back().time_s, end().sim_time_s);
  EXPECT_EQ(ran_on_.trace.now_s(), run_on().sim_time_s);
  EXPECT_EQ(ran_on_.trace.rests.back().sample.activity, "stall");
  EXPECT_EQ(ran_on_.trace.events.back().time_s, run_on().sim_time_s);
  EXPECT_EQ(ran_on_.trace.samples.size(), ended_.trace.samples.size());
}

TEST(FreeRoverTest, WhatIsNotStuckHasNoStall) {
  for (const std::string option : {"end", "run_on"}) {
    const DriveResult result =
        RunTrial(Pathfinder("level_sand", {"referee.stuck_rover=" + option}), {1, 0});
    ASSERT_EQ(result.outcome, TrialOutcome::kGoalReached);
    EXPECT_EQ(result.record.stall_time_s, 0.0);
    EXPECT_EQ(result.record.stall_energy_wh, 0.0);
    EXPECT_EQ(result.record.active_time_s, result.record.sim_time_s);
  }
}

}  // namespace
}  // namespace rockyard::trial
