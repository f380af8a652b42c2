// What a move of the map-based navigator takes, and what the rover believes of its height.
#include <gtest/gtest.h>

#include <cmath>

#include "math/angles.h"
#include "trial/eyes/compute_profile.h"
#include "trial/eyes/compute_tables.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

// Twenty whole steps over empty sand, without errors of localization.
DriveParams TwentySteps(const Overrides& overrides = {}) {
  return Gestalt("viking_lander_2", kTrueEncoders +
                                        Overrides{"terrain.rocks.kind=none", "course.goal_x_m=7",
                                                  "localization.estimator=oracle"} +
                                        overrides);
}

// Time of a move beyond its looks.
double DrivingTime(const truth::DriveRecord& record) { return record.move_time_s / record.moves; }

// Table 2: 26.76 s a look and 15 s of driving a move. 154 looks for 105 moves are then 54 s a move.
TEST(GestaltMoveTest, AMoveTakesTheTimeOfTable2) {
  const DriveParams drive = TwentySteps();
  const double look_s = MakeLookTime(drive).total_s();
  EXPECT_NEAR(look_s, 26.762, 1e-9);
  const DriveResult result = RunTrial(drive, {1, 0});
  ASSERT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  const truth::DriveRecord& record = result.record;
  EXPECT_NEAR(record.moves, 20.0, 1.0);
  EXPECT_NEAR(record.sim_time_s,
              StartUpTime(drive) + record.image_sets * look_s + record.moves * DrivingTime(record),
              1e-6);
  EXPECT_NEAR(DrivingTime(record), kAthenaRows.back().time_s, 0.5);
  EXPECT_NEAR(look_s * kAthenaImageSets / kAthenaMoves + DrivingTime(record), 54.25, 0.5);
}

// Negative control: wheels alone take about half of it.
TEST(GestaltMoveTest, WheelsAloneTakeLess) {
  const DriveResult result = RunTrial(TwentySteps({"clock.compute.move_overhead_s=0"}), {1, 0});
  ASSERT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  EXPECT_EQ(result.record.move_overhead_time_s, 0.0);
  EXPECT_LT(DrivingTime(result.record), 9.0);
  EXPECT_GT(DrivingTime(result.record), 6.5);
}

// The overhead is spent at rest: the course stays what it was, tick by tick.
TEST(GestaltMoveTest, TheOverheadChangesTimeAndEnergyAlone) {
  const truth::DriveRecord with = RunTrial(TwentySteps(), {1, 0}).record;
  const truth::DriveRecord without =
      RunTrial(TwentySteps({"clock.compute.move_overhead_s=0"}), {1, 0}).record;
  EXPECT_EQ(with.true_distance_m, without.true_distance_m);
  EXPECT_EQ(with.moves, without.moves);
  EXPECT_EQ(with.compute_time_s, without.compute_time_s);
  EXPECT_NEAR(with.sim_time_s - without.sim_time_s, 7.3 * with.moves, 1e-6);
  const double base_W = 3.77 + 0.80;  // Matthies 1995, table 1
  EXPECT_NEAR(with.energy_wh - without.energy_wh, 7.3 * with.moves * base_W / 3600.0, 1e-9);
}

// Along a slope of s a rover that takes the ground to be flat is wrong by -d tan(s); one that knows
// its pose is not; one that keeps no map is not asked.
TEST(GestaltMoveTest, HeightErrorIsBelievedLessTrueHeight) {
  constexpr double kSlope_deg = 5.0;
  const Overrides slope = {"terrain.rocks.kind=none", "course.goal_x_m=3",
                           "terrain.ground.slope_deg=" + std::to_string(kSlope_deg)};
  const auto drive = [&](const Overrides& overrides) {
    return RunTrial(Gestalt("abundance", slope + overrides), {1, 0}).record;
  };
  const truth::DriveRecord flat = drive({"perception.attitude.height=level"});
  EXPECT_GT(flat.final_x_m, 1.0);
  const double climb_m = std::tan(math::DegToRad(kSlope_deg)) * flat.final_x_m;
  EXPECT_NEAR(flat.height_error_m, -climb_m, 0.02 * climb_m);
  EXPECT_EQ(drive({"localization.estimator=oracle"}).height_error_m, 0.0);
  EXPECT_LT(std::abs(drive({}).height_error_m), 0.25 * climb_m);
  const truth::DriveRecord behaviour = RunTrial(Pathfinder("nominal", slope), {1, 0}).record;
  EXPECT_GT(behaviour.final_x_m, 1.0);
  EXPECT_EQ(behaviour.height_error_m, 0.0);
}

}  // namespace
}  // namespace rockyard::trial
