// The quasi-static rover on rocks and at walls: climbing, scraping, getting stuck.
#include <gtest/gtest.h>

#include <algorithm>

#include "rover/quasi_static/fields.h"
#include "rover/rover_drive.h"

namespace rockyard::rover {
namespace {

RoverParams QuasiStatic() { return WithFidelity(Fidelity::kQuasiStatic); }

// Wheels over a low rock on one side: the wheel centre rises to the rock's top plus the radius less
// the sinkage, and the bogie's angle follows from its length.
TEST(QuasiStaticRock, BogieAngleFromGeometry) {
  const RoverParams params = QuasiStatic();
  const double top_m = 0.05;
  const RoverOn rover(FlatTerrain({MakeRock(0.26, 0.2, 0.0, 0.1, 0.1, top_m)}), params);
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  const double length_m = geometry.wheel_R[0].x() - geometry.wheel_R[1].x();
  const truth::RoverState& state = rover->state();
  // Pitch of the bogie in W: chassis, rocker and bogie about the same axis.
  const double bogie_rad = Pitch(state.X_WR) + state.left_rocker_rad + state.left_bogie_rad;
  EXPECT_NEAR(bogie_rad, -std::asin(top_m / length_m), math::DegToRad(1.0));
  EXPECT_NEAR(state.left_rocker_rad + state.right_rocker_rad, 0.0, 1e-12);
}

// A wheel that is steered into a rock while the rover stands pushes the rover away.
TEST(QuasiStaticRock, SteeringAtRestLeavesNoWheelInsideARock) {
  const RoverParams params = QuasiStatic();
  const RoverOn rover(FlatTerrain({MakeRock(0.30, -0.345, 0.1, 0.1, 0.1, 0.3)}), params);
  const math::Vector3 before = rover->state().X_WR.translation();
  RunFor(*rover, SteerOnly(Drive(params, 0.0, -0.4)), 1.0);
  EXPECT_GT((rover->state().X_WR.translation() - before).norm(), 0.001);
}

// How far each wheel turns in a second of what it is told, of a rover that has driven against a
// rock as wide as itself and higher than its wheels.
messages::PerWheel<double> TurnSharesAtAWall(Fidelity fidelity, double stall_torque_Nm) {
  RoverParams params = WithFidelity(fidelity);
  params.drive.stall_torque_Nm = stall_torque_Nm;
  const RoverOn rover(FlatTerrain({MakeRock(0.7, 0.0, 0.0, 0.2, 2.0, 0.6)}), params);
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

// Wheels that turn by less than a fifth of what they are told, second by second: how many, how many
// of them with a mean motor torque below nine tenths of that of stall, and the least of these over
// it.
struct Stalled {
  int seconds = 0;
  int weak = 0;
  double least_torque = 2.0;
};

Stalled StalledWheels(Fidelity fidelity, const terrain::Terrain& terrain, double time_s,
                      double stall_torque_Nm) {
  RoverParams params = WithFidelity(fidelity);
  params.drive.stall_torque_Nm = stall_torque_Nm;
  const auto rover = PlacedRover(params, terrain);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  const int steps = static_cast<int>(std::lround(1.0 / rover->step_s()));
  Stalled result;
  for (int second = 0; second < time_s; ++second) {
    const messages::PerWheel<double> before = rover->state().wheel_angle_rad;
    messages::PerWheel<double> torque{};
    for (int step = 0; step < steps; ++step) {
      rover->Step(command);
      for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
        torque[i] += rover->state().motor_torque_Nm[i] / params.drive.stall_torque_Nm / steps;
      }
    }
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      const double turned_rad = rover->state().wheel_angle_rad[i] - before[i];
      if (turned_rad > 0.2 * command.rate_rad_s[i]) continue;
      ++result.seconds;
      if (torque[i] < 0.9) ++result.weak;
      result.least_torque = std::min(result.least_torque, torque[i]);
    }
  }
  return result;
}

// The ground's force across a wheel takes nothing from its motor: along a slope that falls to the
// right, the rear wheels that stand show their stall torque, as in the multibody.
TEST(QuasiStaticMotor, AStalledWheelShowsItsStallTorqueUnderASideForce) {
  terrain::GroundParams ground{.slope_rad = math::DegToRad(3.0),
                               .slope_direction_rad = math::DegToRad(90.0),
                               .soil = BekkerSoil()};
  const terrain::Terrain terrain(terrain::Ground(ground, {}),
                                 {MakeRock(0.7, 0.0, 0.0, 0.2, 2.0, 0.6)}, {});
  for (const Fidelity fidelity : {Fidelity::kQuasiStatic, Fidelity::kMultibody}) {
    const Stalled stalled = StalledWheels(fidelity, terrain, 12.0, 2.0);
    EXPECT_GE(stalled.seconds, 4);
    EXPECT_GT(stalled.least_torque, 0.97);
  }
}

// Contacts at the flank of a wheel have a shorter arm than its radius: they ask for more force. A
// wheel that stalls for a part of its second shows less.
TEST(QuasiStaticMotor, AWheelStalledByAnyContactShowsItsStallTorque) {
  int seconds = 0;
  int weak = 0;
  for (int field = 0; field < 4; ++field) {
    const Stalled stalled =
        StalledWheels(Fidelity::kQuasiStatic, ScatteredRocks(0.03, 0.6, field), 40.0, 0.7);
    seconds += stalled.seconds;
    weak += stalled.weak;
  }
  EXPECT_GE(seconds, 500);
  EXPECT_LE(weak, seconds / 100);
}

}  // namespace
}  // namespace rockyard::rover
