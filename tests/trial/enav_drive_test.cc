// Whole drives of ENav/ACE: easy ground, on the move, and a rover of Perseverance's geometry.

#include <gmock/gmock.h>

#include "rover/rover_layout_params.h"
#include "trial/shipped_trials.h"
#include "trial/sight/onboard_calibration.h"

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

DriveParams Enav(const std::string& name, const Overrides& overrides = {}) {
  return scenario::Shipped("navigation/" + name, overrides).drive;
}

// Where every first path passes a cycle takes the 24 checks of 6 m, or of what they are in
// proportion; near the goal fewer.
TEST(EnavDriveTest, ArrivesOnEmptySandWithEitherRover) {
  for (const auto& [name, metre_m] : {std::pair{"enav", 0.84 / 2.26}, {"enav_perseverance", 1.0}}) {
    const DriveParams drive =
        Enav(name, {"terrain.rocks.kind=none", "course.goal_x_m=8", "localization.estimator=oracle",
                    "sensors.stereo.fidelity=ideal"});
    const DriveResult result = RunTrial(drive, {1, 0});
    EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached) << name << ": " << result.detail;
    EXPECT_NEAR(result.record.true_distance_m, 7.75, 0.1) << name;
    EXPECT_NEAR(result.record.image_sets, 7.75 / metre_m, 2.0) << name;
    ASSERT_EQ(result.own_values.navigator.size(), 4u);
    const double cycles = result.own_values.navigator[0];
    const double checks_per_cycle = result.own_values.navigator[1];
    EXPECT_EQ(cycles, result.record.image_sets) << name;
    EXPECT_GT(checks_per_cycle, 14.0) << name;
    EXPECT_LE(checks_per_cycle, 24.0) << name;
    EXPECT_EQ(result.own_values.navigator[2], 0.0) << name;
    EXPECT_NEAR(result.own_values.navigator[3], 12.5e-3 * cycles * checks_per_cycle, 1e-9) << name;
  }
}

TEST(EnavDriveTest, ArrivesAmongFewRocks) {
  for (const DriveResult& result : RunTrials(Enav("enav"), 4)) {
    EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  }
}

// What planning takes on the rover's computer is time at rest; on the move it is not.
TEST(EnavDriveTest, PlansOnTheMoveInLessTime) {
  const Overrides plain = {"terrain.rocks.kind=none"};
  const DriveResult rests = RunTrial(Enav("enav", plain), {1, 0});
  const DriveResult slow =
      RunTrial(Enav("enav", plain + Overrides{"clock.compute.operations_per_s=26.6e6"}), {1, 0});
  EXPECT_NEAR(slow.record.sim_time_s - rests.record.sim_time_s, 9.0 * rests.own_values.navigator[3],
              1e-6);
  const DriveResult moves = RunTrial(
      Enav("enav", plain + Overrides{"navigation.enav.continuous.cycle=csod",
                                     "clock.overlap.imaging=true", "clock.overlap.computing=true"}),
      {1, 0});
  EXPECT_EQ(moves.outcome, TrialOutcome::kGoalReached) << moves.detail;
  EXPECT_GT(moves.record.plans_on_the_move, 10.0);
  EXPECT_LT(moves.record.sim_time_s, rests.record.sim_time_s);
}

TEST(EnavDriveTest, TheRoverBelievesWhereItsPivotsAre) {
  for (const char* name : {"enav", "enav_perseverance"}) {
    const DriveParams drive = Enav(name);
    const messages::SuspensionBelief believed =
        OnboardRoverBelief(drive.rover, drive.perception.calibration.drive,
                           drive.perception.vehicle_hazard)
            .suspension;
    const rover::RoverGeometry geometry = rover::MakeRoverGeometry(drive.rover.geometry);
    EXPECT_EQ(believed.bogies_at_front, geometry.on_bogie[0]);
    EXPECT_EQ(
        math::Vector3(believed.rocker_pivot_x_m, believed.pivot_y_m, believed.rocker_pivot_z_m),
        geometry.rocker_pivot_R[0]);
    EXPECT_EQ(math::Vector3(believed.bogie_pivot_x_m, believed.pivot_y_m, believed.bogie_pivot_z_m),
              geometry.bogie_pivot_R[0]);
    EXPECT_EQ(believed.belly_length_m, drive.rover.geometry.belly_length_m);
    EXPECT_EQ(believed.belly_width_m, drive.rover.geometry.belly_width_m);
  }
}

}  // namespace
}  // namespace rockyard::trial
