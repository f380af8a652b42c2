// Slip of the driving rover on slopes against the soil's curve.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

using messages::kWheelCount;
using messages::PerWheel;

// Firm enough for 30 deg.
terrain::SoilParams FirmSoil() {
  return terrain::SoilParams{.friction_angle_rad = math::DegToRad(45.0), .shear_modulus_m = 0.002};
}

struct SlipCase {
  terrain::SoilParams soil;
  double slope_deg = 10.0;
  double speed_m_s = 0.15;
  double rate_Hz = 60.0;
  double gravity_m_s2 = 9.81;
};

// Wheels of one rigid rover share one slip: at it their tractions add up to weight and resistance.
void ExpectSlipOfTheCurve(const SlipCase& c) {
  RoverParams params{.drive = {.speed_m_s = c.speed_m_s},
                     .physics = {.step_s = 1.0 / c.rate_Hz, .gravity_m_s2 = c.gravity_m_s2}};
  const double slope = math::DegToRad(c.slope_deg);
  const RoverOn rover(SlopeTerrain(slope, 0.0, c.soil), params);
  const messages::WheelCommand command = Drive(params, c.speed_m_s, 0.0);
  RunFor(*rover, command, 4.0);
  const truth::RoverState from = rover->state();
  RunFor(*rover, command, 4.0);
  const truth::RoverState& to = rover->state();
  const SoilReference reference{c.soil};
  const double pull_N =
      Weights(params).total_N * std::sin(slope) + reference.SumResistance(to.wheel_load_N);
  const double expected = reference.SlipForPull(pull_N, to.wheel_load_N);
  ASSERT_LT(expected, 0.9);
  const double rolled_m =
      params.geometry.wheel_radius_m * (to.wheel_angle_rad[0] - from.wheel_angle_rad[0]);
  const double slip = 1.0 - (to.X_WR.translation() - from.X_WR.translation()).norm() / rolled_m;
  EXPECT_NEAR(slip, expected, 0.01 * expected + 5e-4)
      << c.slope_deg << " deg, " << c.speed_m_s << " m/s, " << c.rate_Hz << " Hz, "
      << c.gravity_m_s2 << " m/s2";
}

TEST(Slip, FollowsTheCurveOfTheDefaultSand) {
  for (const double slope_deg : {0.0, 5.0, 10.0, 15.0, 18.0}) ExpectSlipOfTheCurve({{}, slope_deg});
}

TEST(Slip, FollowsTheCurveOfFirmSoilUpTo30Degrees) {
  for (const double slope_deg : {5.0, 10.0, 15.0, 20.0, 25.0, 30.0}) {
    ExpectSlipOfTheCurve({FirmSoil(), slope_deg});
  }
}

TEST(Slip, DoesNotDependOnSpeedOrStep) {
  for (const double speed_m_s : {0.0067, 0.05, 0.15}) {
    for (const double rate_Hz : {60.0, 120.0}) {
      ExpectSlipOfTheCurve({{}, 12.0, speed_m_s, rate_Hz});
    }
  }
}

TEST(Slip, FollowsTheCurveUnderMarsGravity) {
  ExpectSlipOfTheCurve({{}, 10.0, 0.15, 60.0, 3.72});
  ExpectSlipOfTheCurve(
      {terrain::MakeSoil(terrain::SoilPreset::kMarsDrift), 5.0, 0.0067, 60.0, 3.72});
}

// Near the largest traction a little more pull takes much more slip; wheels that share one slip
// must not take turns in pulling for that.
TEST(Slip, WheelsPullSteadilyNearTheLargestTraction) {
  const RoverParams params;
  terrain::SoilParams soil{.shear_modulus_m = 0.001};
  const RoverOn rover(SlopeTerrain(math::DegToRad(26.0), 0.0, soil), params);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  RunFor(*rover, command, 4.0);
  for (int i = 0; i < 120; ++i) {
    const PerWheel<double> before_Nm = rover->state().motor_torque_Nm;
    rover->Step(command);
    for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
      EXPECT_NEAR(rover->state().motor_torque_Nm[wheel], before_Nm[wheel], 1e-3);
    }
  }
}

// Planar motion (v_x, v_y, turn rate) of six straight wheels with the given rim speed on a slope
// that pulls with force_N at the centre of mass: each wheel's friction is opposite to the velocity
// s of its contact over the soil, as large as the slip |s| / rim mobilizes, and its resistance acts
// backwards.
Eigen::Vector3d SteadyMotion(const RoverParams& params, const PerWheel<double>& loads_N,
                             const math::Vector3& force_N, double rim_m_s) {
  const SoilReference soil;
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  Eigen::Vector3d motion(rim_m_s, 0.0, 0.0);
  for (int round = 0; round < 60; ++round) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b(force_N.x(), force_N.y(), Weights(params).com_x_m * force_N.y());
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const math::Vector3& p = geometry.wheel_R[i];
      // Velocity and force along x, then y; rows of J map motion to the velocity at the wheel.
      Eigen::Matrix<double, 2, 3> J;
      J << 1.0, 0.0, -p.y(), 0.0, 1.0, p.x();
      const Eigen::Vector2d rim(rim_m_s, 0.0);
      const double slip_m_s = std::max((J * motion - rim).norm(), 1e-9);
      const double viscosity = soil.Share(std::min(slip_m_s / rim_m_s, 1.0), loads_N[i]) *
                               soil.LargestTraction(loads_N[i]) / slip_m_s;
      A += viscosity * J.transpose() * J;
      b += J.transpose() * (viscosity * rim - Eigen::Vector2d(soil.Resistance(loads_N[i]), 0.0));
    }
    motion = A.inverse() * b;
  }
  return motion;
}

// Along the contour of a cross slope the rover drifts downhill, and its heavier lower side, held
// back more, turns it downhill.
TEST(Slip, SideSlipOnACrossSlope) {
  for (const double slope_deg : {5.0, 10.0, 15.0}) {
    const RoverParams params;
    const double slope = math::DegToRad(slope_deg);
    const RoverOn rover(SlopeTerrain(slope, 0.5 * std::numbers::pi), params);
    RunFor(*rover, Drive(params, 0.15, 0.0), 1.5);
    const truth::RoverState& state = rover->state();
    const math::Vector3 down_R = state.X_WR.linear().transpose() * -math::Vector3::UnitZ();
    const Eigen::Vector3d expected =
        SteadyMotion(params, state.wheel_load_N, Weights(params).total_N * down_R, 0.15);
    const math::Vector3 v_R = state.X_WR.linear().transpose() * state.v_WR_m_s;
    ASSERT_LT(expected.y(), -0.002);
    EXPECT_NEAR(v_R.x(), expected.x(), 0.01 * expected.x()) << slope_deg;
    EXPECT_NEAR(v_R.y(), expected.y(), -0.03 * expected.y()) << slope_deg;
    EXPECT_NEAR(state.w_WR_rad_s.dot(state.X_WR.linear().col(2)), expected.z(),
                0.05 * std::abs(expected.z()) + 5e-4)
        << slope_deg;
  }
}

}  // namespace
}  // namespace rockyard::rover
