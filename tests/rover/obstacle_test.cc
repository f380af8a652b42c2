// Climbing, scraping, getting stuck.
#include <gtest/gtest.h>

#include "rover_drive.h"

namespace rockyard::rover {
namespace {

enum class Climb { kUp, kStuck, kTippedOver };

// Drives against a step of friction mu that stands on hard ground of the same friction.
Climb TryStep(double height_m, double friction, const RoverParams& rover_params = {}) {
  RoverParams params = rover_params;
  params.contact.wheel_rock_friction = friction;
  const terrain::Terrain terrain = StepTerrain(height_m, RigidGround(friction));
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  // The rear wheels stand on the step from x = 0.6 + 0.26 on.
  for (int i = 0; i < 20 * 60; ++i) {
    rover->Step(command);
    if (math::Tilt(rover->state().X_WR) > math::DegToRad(60.0)) return Climb::kTippedOver;
    if (rover->state().X_WR.translation().x() > 1.0) return Climb::kUp;
  }
  return Climb::kStuck;
}

// Matthies 1995 sec. 2: designed to climb vertical steps of 1.5 wheel diameters. Half the default
// torque of 4 Nm is enough; the wheel at the step presses it with what the other wheels push, and
// lifts itself by friction.
TEST(Step, ClimbsUpToOneAndAHalfWheelDiameters) {
  for (const double stall_torque_Nm : {2.0, 4.0}) {
    RoverParams params;
    params.drive.stall_torque_Nm = stall_torque_Nm;
    for (const double height_m : {0.10, 0.13, 0.195}) {
      for (const double friction : {0.8, 1.0}) {
        EXPECT_EQ(TryStep(height_m, friction, params), Climb::kUp) << height_m << ", " << friction;
      }
    }
  }
}

// At a friction of 0.8 it does not get up two wheel diameters, at 1.0 not two and a half.
TEST(Step, FailsOnHigherSteps) {
  EXPECT_NE(TryStep(0.26, 0.8), Climb::kUp);
  EXPECT_NE(TryStep(0.325, 1.0), Climb::kUp);
}

TEST(Step, FailsWithoutFrictionOrTorque) {
  EXPECT_EQ(TryStep(0.13, 0.2), Climb::kStuck);
  RoverParams weak;
  weak.drive.stall_torque_Nm = 0.5;
  EXPECT_EQ(TryStep(0.13, 0.8, weak), Climb::kStuck);
}

// One side over a rock: the chassis takes half of that side's pitch.
TEST(Rock, DifferentialHalvesThePitchOfOneSide) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.6, 0.2, 0.0, 0.15, 0.15, 0.1)});
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  double max_rad = 0.0;
  for (int i = 0; i < 600; ++i) {
    rover->Step(command);
    const truth::RoverState& s = rover->state();
    EXPECT_NEAR(s.left_rocker_rad + s.right_rocker_rad, 0.0, math::DegToRad(0.5));
    const double roll = std::atan2(s.X_WR.linear()(2, 1), s.X_WR.linear()(2, 2));
    const double chassis = Pitch(s.X_WR);
    // Where the right side stands level, its rocker takes back what the chassis leans.
    EXPECT_NEAR(chassis + s.right_rocker_rad, 0.0, math::DegToRad(1.5) + 0.1 * std::abs(roll));
    max_rad = std::max(max_rad, std::abs(s.left_rocker_rad));
  }
  EXPECT_GT(max_rad, math::DegToRad(2.0));
}

TEST(Rock, LowerThanTheBellyPassesBetweenTheWheels) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.1, 0.1, 0.12)});
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  for (int i = 0; i < 600; ++i) {
    rover->Step(command);
    EXPECT_TRUE(rover->state().contacts.empty());
  }
  EXPECT_GT(rover->state().X_WR.translation().x(), 1.3);
}

}  // namespace
}  // namespace rockyard::rover
