// The quasi-static rover on rocks and at walls: climbing, scraping, getting stuck.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rover/rover_drive.h"

namespace rockyard::rover {
namespace {

using truth::BodyPart;

RoverParams QuasiStatic() {
  RoverParams params;
  params.fidelity = Fidelity::kQuasiStatic;
  return params;
}

// Wheels over a low rock on one side: the wheel centre rises to the rock's top plus the radius less
// the sinkage, and the bogie's angle follows from its length.
TEST(QuasiStaticRock, BogieAngleFromGeometry) {
  const RoverParams params = QuasiStatic();
  const double top_m = 0.05;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.26, 0.2, 0.0, 0.1, 0.1, top_m)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  const double length_m = geometry.wheel_R[0].x() - geometry.wheel_R[1].x();
  const truth::RoverState& state = rover->state();
  // Pitch of the bogie in W: chassis, rocker and bogie about the same axis.
  const double bogie_rad = Pitch(state.X_WR) + state.left_rocker_rad + state.left_bogie_rad;
  EXPECT_NEAR(bogie_rad, -std::asin(top_m / length_m), math::DegToRad(1.0));
  EXPECT_NEAR(state.left_rocker_rad + state.right_rocker_rad, 0.0, 1e-12);
}

TEST(QuasiStaticRock, LowerThanTheBellyPassesBetweenTheWheels) {
  const RoverParams params = QuasiStatic();
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.1, 0.1, 0.12)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  for (int i = 0; i < 200; ++i) {
    rover->Step(command);
    EXPECT_TRUE(rover->state().contacts.empty());
  }
  EXPECT_GT(rover->state().X_WR.translation().x(), 1.3);
}

TEST(QuasiStaticRock, TallerThanTheBellyBlocksItUntilItBacksOff) {
  const RoverParams params = QuasiStatic();
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.6, 0.0, 0.0, 0.12, 0.12, 0.2)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, Drive(params, 0.15, 0.0), 10.0);
  const truth::RoverState& state = rover->state();
  EXPECT_LT(state.X_WR.translation().x(), 0.5);
  ASSERT_EQ(state.contacts.size(), 1U);
  EXPECT_EQ(state.contacts[0].part, BodyPart::kBelly);
  EXPECT_EQ(state.contacts[0].rock, 0);
  EXPECT_GT(state.contacts[0].normal_force_N, 50.0);
  const double blocked_x = state.X_WR.translation().x();
  RunFor(*rover, Drive(params, -0.15, 0.0), 1.0);
  EXPECT_LT(rover->state().X_WR.translation().x(), blocked_x - 0.1);
}

TEST(QuasiStaticWall, StopsTheRover) {
  const RoverParams params = QuasiStatic();
  const terrain::Terrain terrain = FlatTerrain({}, {{math::Vector3::UnitX(), 0.8}});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, Drive(params, 0.15, 0.0), 6.0);
  EXPECT_NEAR(rover->state().X_WR.translation().x(), 0.8 - 0.5 * params.geometry.length_m, 0.01);
}

// A wheel that is steered into a rock while the rover stands pushes the rover away.
TEST(QuasiStaticRock, SteeringAtRestLeavesNoWheelInsideARock) {
  const RoverParams params = QuasiStatic();
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.30, -0.345, 0.1, 0.1, 0.1, 0.3)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const math::Vector3 before = rover->state().X_WR.translation();
  RunFor(*rover, SteerOnly(Drive(params, 0.0, -0.4)), 1.0);
  EXPECT_GT((rover->state().X_WR.translation() - before).norm(), 0.001);
}

// How far each wheel turns in a second of what it is told, of a rover that has driven against a
// rock as wide as itself and higher than its wheels.
messages::PerWheel<double> TurnSharesAtAWall(Fidelity fidelity, double stall_torque_Nm) {
  RoverParams params;
  params.fidelity = fidelity;
  params.drive.stall_torque_Nm = stall_torque_Nm;
  const terrain::Terrain terrain = FlatTerrain({MakeRock(0.7, 0.0, 0.0, 0.2, 2.0, 0.6)});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  RunFor(*rover, command, 6.0);
  const messages::PerWheel<double> before = rover->state().wheel_angle_rad;
  RunFor(*rover, command, 1.0);
  messages::PerWheel<double> shares{};
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    shares[i] = (rover->state().wheel_angle_rad[i] - before[i]) / command.rate_rad_s[i];
  }
  return shares;
}

// Strong motors spin their wheels. The rover stands up against the rock, so that its rear wheels
// bear most of it: these stand where the motors are weak, and the others spin. The multibody has
// motors of its own and says the same.
TEST(QuasiStaticMotor, AWheelThatTheMotorCannotTurnStands) {
  for (const Fidelity fidelity : {Fidelity::kQuasiStatic, Fidelity::kMultibody}) {
    const messages::PerWheel<double> strong = TurnSharesAtAWall(fidelity, 20.0);
    const messages::PerWheel<double> weak = TurnSharesAtAWall(fidelity, 2.0);
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      EXPECT_NEAR(strong[i], 1.0, 0.02) << "wheel " << i;
      const bool rear = i % 3 == 2;
      EXPECT_NEAR(weak[i], rear ? 0.0 : 1.0, 0.05) << "wheel " << i;
    }
  }
}

// What the wheels do in a second, against a rock as above along a slope that falls to the right by
// 3 deg: how far they turn of what they are told, and their mean motor torque over that of stall.
struct AcrossASlope {
  messages::PerWheel<double> share{}, torque{};
};

AcrossASlope AtAWallAcrossASlope(Fidelity fidelity) {
  RoverParams params;
  params.fidelity = fidelity;
  params.drive.stall_torque_Nm = 2.0;
  terrain::GroundParams ground;
  ground.slope_rad = math::DegToRad(3.0);
  ground.slope_direction_rad = math::DegToRad(90.0);
  const terrain::Terrain terrain(terrain::Ground(ground, {}),
                                 {MakeRock(0.7, 0.0, 0.0, 0.2, 2.0, 0.6)}, {});
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  RunFor(*rover, command, 6.0);
  const messages::PerWheel<double> before = rover->state().wheel_angle_rad;
  AcrossASlope result;
  const int steps = static_cast<int>(std::lround(1.0 / rover->step_s()));
  for (int step = 0; step < steps; ++step) {
    rover->Step(command);
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      result.torque[i] += rover->state().motor_torque_Nm[i] / params.drive.stall_torque_Nm / steps;
    }
  }
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    result.share[i] = (rover->state().wheel_angle_rad[i] - before[i]) / command.rate_rad_s[i];
  }
  return result;
}

// The ground's force across a wheel takes nothing from its motor: a wheel that stands shows its
// stall torque.
TEST(QuasiStaticMotor, AStalledWheelShowsItsStallTorqueUnderASideForce) {
  const AcrossASlope quasi_static = AtAWallAcrossASlope(Fidelity::kQuasiStatic);
  const AcrossASlope multibody = AtAWallAcrossASlope(Fidelity::kMultibody);
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    EXPECT_NEAR(quasi_static.share[i], multibody.share[i], 0.1) << "wheel " << i;
    EXPECT_NEAR(quasi_static.torque[i], multibody.torque[i], 0.1) << "wheel " << i;
    const bool rear = i % 3 == 2;
    EXPECT_EQ(quasi_static.share[i] < 0.2, rear) << "wheel " << i;
    if (rear) {
      EXPECT_GT(quasi_static.torque[i], 0.98) << "wheel " << i;
    }
  }
}

}  // namespace
}  // namespace rockyard::rover
