// Every way in which a drive can end, provoked by a small scenario.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "trial/shipped_trials.h"
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
  const auto turned_at_the_start = [](const std::string& scale) {
    return LevelSand({"course.start_heading_deg=90", "sensors.gyro.scale=" + scale});
  };
  EXPECT_EQ(turned_at_the_start("0.5"), TrialOutcome::kFalseGoal);
  EXPECT_EQ(turned_at_the_start("1"), TrialOutcome::kGoalReached);
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
    const Overrides off{"perception.hazard.enabled=true", "clock.scan_time_s=3600",
                        "referee.no_path_time_s=0", "referee.time_limit_s=0",
                        "energy.battery_wh=0"};
    return RunTrial(Pathfinder("level_sand", off + more), {1, 0});
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
  const Overrides ends = {"terrain.arena.kind=virtual_reflected"};
  EXPECT_EQ(LevelSand(overshoot + ends), TrialOutcome::kLeftArena);
  EXPECT_EQ(LevelSand(overshoot), TrialOutcome::kFalseGoal);  // open arenas have no ends
}

// Whether a drive ends since soil in which a wheel of 6.5 cm under a sixth of the rover sinks by
// `sinkage_m` has swallowed the wheels. For n = 1, N = 2/3 b k sqrt(D) z^1.5.
bool IsSwallowed(double sinkage_m, double wheel_radius_m, const std::string& fidelity) {
  constexpr double kLoad_N = 20.0 * 9.81 / 6.0;
  const double modulus = 1.5 * kLoad_N / (0.08 * std::sqrt(2.0 * 0.065) * std::pow(sinkage_m, 1.5));
  const DriveResult result = RunTrial(
      Pathfinder("level_sand",
                 {"rover.fidelity=" + fidelity, "terrain.ground.soil.sinkage_exponent=1",
                  "terrain.ground.soil.cohesive_modulus_N_per_mn1=0",
                  "terrain.ground.soil.frictional_modulus_N_per_mn2=" + std::to_string(modulus),
                  "rover.geometry.wheel_radius_m=" + std::to_string(wheel_radius_m),
                  "referee.time_limit_s=30"}),
      {1, 0});
  return result.detail.find("sank into the soil") != std::string::npos;
}

// The limit is the radius of the wheels that the rover has. Smaller ones sink a little deeper in
// the same soil, as z grows with D^(-1/3), and reach their axles where those of 6.5 cm do not.
TEST(Embedded, FollowsTheRadiusOfTheRoversWheels) {
  for (const std::string fidelity : {"multibody", "quasi_static"}) {
    EXPECT_FALSE(IsSwallowed(0.059, 0.065, fidelity)) << fidelity;
    EXPECT_TRUE(IsSwallowed(0.071, 0.065, fidelity)) << fidelity;
    EXPECT_FALSE(IsSwallowed(0.047, 0.055, fidelity)) << fidelity;
    EXPECT_TRUE(IsSwallowed(0.059, 0.055, fidelity)) << fidelity;
  }
}

}  // namespace
}  // namespace rockyard::trial
