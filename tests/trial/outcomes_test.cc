// Every way in which a drive can end, provoked by a small scenario.
#include <gtest/gtest.h>

#include <map>

#include "trial/pathfinder_trials.h"
#include "truth/end_cause.h"

namespace rockyard::trial {
namespace {

using truth::EndCause;
using truth::TrialOutcome;

// Drives over level, rock-free sand without scans cost a few hundredths of a second.
TrialOutcome LevelSand(const Overrides& overrides) {
  return RunTrial(Pathfinder("level_sand", overrides), {1, 0}).outcome;
}

std::map<TrialOutcome, int> Count(const std::vector<DriveResult>& results) {
  std::map<TrialOutcome, int> counts;
  for (const DriveResult& result : results) ++counts[result.outcome];
  return counts;
}

TEST(OutcomesTest, GoalReached) { EXPECT_EQ(LevelSand({}), TrialOutcome::kGoalReached); }

TEST(OutcomesTest, FalseGoalWhereTheGyroIsWrong) {
  const Overrides turn_at_the_start = {"course.start_heading_deg=90"};
  Overrides wrong_gyro = turn_at_the_start;
  wrong_gyro.push_back("sensors.gyro.scale=0.5");
  Overrides right_gyro = turn_at_the_start;
  right_gyro.push_back("sensors.gyro.scale=1");
  EXPECT_EQ(LevelSand(wrong_gyro), TrialOutcome::kFalseGoal);
  EXPECT_EQ(LevelSand(right_gyro), TrialOutcome::kGoalReached);
}

TEST(OutcomesTest, TipOverOnSlopes) {
  EXPECT_EQ(LevelSand({"terrain.ground.slope_deg=25", "referee.tip_over_deg=20"}),
            TrialOutcome::kTipOver);
  EXPECT_NE(LevelSand({"terrain.ground.slope_deg=15", "referee.tip_over_deg=20"}),
            TrialOutcome::kTipOver);
}

TEST(OutcomesTest, TipOverOnVeryRoughGround) {
  const DriveParams drive = Pathfinder("level_sand", {"terrain.ground.roughness_rms_m=0.3",
                                                      "terrain.ground.roughness_wavelength_m=1.5",
                                                      "terrain.ground.soil.friction_angle_deg=56"});
  const std::vector<DriveResult> results = RunTrials(drive, 6);
  EXPECT_GE(Count(results)[TrialOutcome::kTipOver], 2);
  for (const DriveResult& result : results) {
    EXPECT_EQ(result.outcome == TrialOutcome::kTipOver, result.record.max_tilt_deg > 60.0);
  }
}

TEST(OutcomesTest, JammedOrHighCentredWhereTheRoverDrivesBlindlyIntoRocks) {
  const DriveParams drive = Pathfinder("obstacles_2.0", {"perception.hazard.enabled=false"});
  std::map<TrialOutcome, int> counts = Count(RunTrials(drive, 8));
  EXPECT_GE(counts[TrialOutcome::kJammed], 1);
  EXPECT_GE(counts[TrialOutcome::kHighCentred], 1);
}

// On loose sand its steered wheels push it off the wall, and it turns away.
TEST(OutcomesTest, JammedAtAWall) {
  EXPECT_EQ(LevelSand({"terrain.arena.kind=walled", "terrain.ground.soil.preset=hard_ground",
                       "course.start_y_m=1.2", "course.start_heading_deg=90"}),
            TrialOutcome::kJammed);
}

TEST(OutcomesTest, NoPath) {
  const auto cause = [](const Overrides& overrides) {
    const DriveResult result = RunTrial(Pathfinder("level_sand", overrides), {1, 0});
    return truth::CauseOf({0, result.outcome, result.detail, {}});
  };
  EXPECT_EQ(cause({"navigation.pathfinder.time_out_s=10"}), EndCause::kGaveUp);
  EXPECT_EQ(cause({"course.start_heading_deg=120", "referee.no_path_distance_m=0.5"}),
            EndCause::kPatienceDistance);
  EXPECT_EQ(cause({"course.start_heading_deg=180", "referee.no_path_turn_deg=90"}),
            EndCause::kPatienceTurning);
}

TEST(OutcomesTest, EnergyDepleted) {
  const DriveResult result = RunTrial(Pathfinder("level_sand", {"energy.battery_wh=0.05"}), {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kEnergyDepleted);
  const double last_tick_wh = 12.85 * 0.05 / 3600.0;
  EXPECT_NEAR(result.record.energy_wh, 0.05, last_tick_wh);
}

TEST(OutcomesTest, TimeLimit) {
  const DriveResult result =
      RunTrial(Pathfinder("level_sand", {"referee.time_limit_s=20"}), {1, 0});
  EXPECT_EQ(result.outcome, TrialOutcome::kTimeLimit);
  EXPECT_NEAR(result.record.sim_time_s, 20.0, 0.05 + 1e-9);
}

// Scans of an hour each, and batteries that seven of them empty.
TEST(OutcomesTest, ClocksThatAreOffEndNothing) {
  const auto drive = [](const Overrides& more) {
    Overrides all{"perception.hazard.enabled=true", "clock.scan_time_s=3600",
                  "referee.no_path_time_s=0", "referee.time_limit_s=0", "energy.battery_wh=0"};
    all.insert(all.end(), more.begin(), more.end());
    return RunTrial(Pathfinder("level_sand", all), {1, 0});
  };
  const DriveResult off = drive({});
  EXPECT_TRUE(truth::DeclaredSuccess(off.outcome));
  EXPECT_GT(off.record.sim_time_s, 50 * 3600.0);
  EXPECT_EQ(drive({"referee.no_path_time_s=3600"}).outcome, TrialOutcome::kNoPath);
  EXPECT_EQ(drive({"referee.time_limit_s=14400"}).outcome, TrialOutcome::kTimeLimit);
  EXPECT_EQ(drive({"energy.battery_wh=50"}).outcome, TrialOutcome::kEnergyDepleted);
}

TEST(OutcomesTest, LeftArenaWhereTheOdometerIsBehind) {
  const Overrides overshoot = {"perception.dead_reckoning.distance_scale=0.6"};
  Overrides with_ends = overshoot;
  with_ends.emplace_back("terrain.arena.kind=virtual_reflected");
  EXPECT_EQ(LevelSand(with_ends), TrialOutcome::kLeftArena);
  EXPECT_EQ(LevelSand(overshoot), TrialOutcome::kFalseGoal);  // open arenas have no ends
}

}  // namespace
}  // namespace rockyard::trial
