// The rover on slopes against closed forms.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>

#include "rover/rover_params.h"
#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

using messages::kWheelCount;
using messages::PerWheel;

constexpr double kUphill = 0.0;
constexpr double kDownhill = std::numbers::pi;
constexpr double kLeftUp = std::numbers::pi / 2;

// Distance along the ground, 3-D, from one position to another.
double Moved(const math::Vector3& from, const truth::RoverState& state) {
  return (state.X_WR.translation() - from).norm();
}

// A body on a slope: half (g sin - g friction cos) t^2 down the fall line, or nothing, whatever the
// gravity and wherever it heads.
double SlideLength(double slope, double friction, double gravity_m_s2, double time_s) {
  const double pull = std::sin(slope) - friction * std::cos(slope);
  return pull > 0.0 ? 0.5 * gravity_m_s2 * pull * time_s * time_s : 0.0;
}

TEST(Slope, BrakedRoverSlidesBeyondTheFrictionAngle) {
  for (const double gravity_m_s2 : {9.81, 3.72}) {
    for (const double direction : {kUphill, kLeftUp, 0.7}) {
      for (const double excess_deg : {-1.0, 1.0, 10.0}) {
        RoverParams params{.physics = {.gravity_m_s2 = gravity_m_s2}};
        const double slope = std::atan(0.5) + math::DegToRad(excess_deg);
        const RoverOn rover(SlopeTerrain(slope, direction, RigidGround(0.5)), params);
        const math::Vector3 from = rover->state().X_WR.translation();
        RunFor(*rover, kBraked, 1.5);
        const double expected_m = SlideLength(slope, 0.5, gravity_m_s2, 1.5);
        EXPECT_NEAR(Moved(from, rover->state()), expected_m, 0.05 * expected_m + 1e-4)
            << "gravity " << gravity_m_s2 << ", direction " << direction << ", " << excess_deg;
      }
    }
  }
}

// The closed form with the plain laws of the rut, and its limits: friction alone, and soil that
// holds nothing.
TEST(Slope, SoilHoldsUpToItsLargestTraction) {
  const RoverParams params;
  for (const terrain::SoilPreset preset :
       {terrain::SoilPreset::kLandscapingSand, terrain::SoilPreset::kMarsDrift,
        terrain::SoilPreset::kHardGround}) {
    const terrain::SoilParams soil = BekkerSoil(preset);
    const SoilReference reference{soil};
    const double held = SteepestHeldSlope_rad(params, soil);
    const double load_N = Weights(params).total_N * std::cos(held) / 6.0;
    EXPECT_NEAR(std::tan(held), reference.LargestTraction(load_N) / load_N, 1e-9);
  }
  EXPECT_NEAR(SteepestHeldSlope_rad(params, RigidGround(0.7)), std::atan(0.7), 1e-9);
  EXPECT_EQ(SteepestHeldSlope_rad(params, RigidGround(0.0)), 0.0);
}

// Across the slope the braked rover stays where it is just below, and slides just above.
TEST(Slope, BrakedRoverStaysUpToWhatTheSoilHolds) {
  for (const terrain::SoilPreset preset :
       {terrain::SoilPreset::kLandscapingSand, terrain::SoilPreset::kMarsDrift}) {
    const terrain::SoilParams soil = BekkerSoil(preset);
    const double held = SteepestHeldSlope_rad({}, soil);
    for (const double excess_deg : {-1.0, 1.0}) {
      const terrain::Terrain terrain =
          SlopeTerrain(held + math::DegToRad(excess_deg), kLeftUp, soil);
      const auto rover = PlacedRover({}, terrain);
      RunFor(*rover, kBraked, 1.0);
      const math::Vector3 from = rover->state().X_WR.translation();
      RunFor(*rover, kBraked, 2.0);
      const double moved_m = Moved(from, rover->state());
      if (excess_deg < 0.0) {
        EXPECT_LT(moved_m, 1e-3);
      } else {
        EXPECT_GT(moved_m, 0.1);
      }
    }
  }
}

// Friction is opposite to the velocity, so nothing pushes the rover sideways and, the loads being
// centred on the fall line through its centre of mass, nothing turns it.
TEST(Slope, SlidesStraightDownTheFallLine) {
  for (const double heading_deg : {0.0, 20.0, 45.0, 70.0, 90.0, 135.0, 200.0}) {
    const RoverParams params;
    const double slope = math::DegToRad(20.0);
    const RoverOn rover(SlopeTerrain(slope, kUphill, RigidGround(0.3)), params,
                        {0.0, 0.0, math::DegToRad(heading_deg)});
    const math::Transform from = rover->state().X_WR;
    RunFor(*rover, kBraked, 1.0);
    const math::Transform& to = rover->state().X_WR;
    const math::Vector3 moved = to.translation() - from.translation();
    const double expected_m = SlideLength(slope, 0.3, 9.81, 1.0);
    EXPECT_NEAR(moved.norm(), expected_m, 0.02 * expected_m) << heading_deg;
    EXPECT_LT(std::abs(moved.y()), 2e-3 * expected_m) << heading_deg;
    EXPECT_LT(std::abs(math::WrapAngle(math::Heading(to) - math::Heading(from))),
              math::DegToRad(0.05))
        << heading_deg;
  }
}

// How far the rover leans beyond the slope within three seconds, braked, at most 35 deg.
double LeanAfter3s(const RoverParams& params, double slope, double direction) {
  const RoverOn rover(SlopeTerrain(slope, direction, RigidGround(3.0)), params);
  double lean = 0.0;
  for (int i = 0; i < 180 && lean < math::DegToRad(35.0); ++i) {
    lean = math::Tilt(rover->state().X_WR) - slope;
    rover->Step(kBraked);
  }
  return lean;
}

// It tips about the lower wheels, somewhere between their middle and their outer edge:
// tan(slope) = distance of that line / height of the centre of mass.
TEST(Slope, TipsOverSidewaysAtTheStaticAngle) {
  const RoverParams params;
  const double middle_y = 0.5 * (params.geometry.width_m - params.geometry.wheel_width_m);
  const double edge_y = 0.5 * params.geometry.width_m;
  const double height = Weights(params).com_z_m;
  EXPECT_LT(LeanAfter3s(params, std::atan(middle_y / height) - math::DegToRad(1.0), kLeftUp),
            math::DegToRad(3.0));
  EXPECT_GT(LeanAfter3s(params, std::atan(edge_y / height) + math::DegToRad(1.0), kLeftUp),
            math::DegToRad(30.0));
}

// Rockers and bogies held by their stops, it tips over its front or rear wheels as one body:
// tan(slope) = distance of their axle from the centre of mass / height of the latter.
TEST(Slope, TipsOverForwardAndBackwardAtTheStaticAngle) {
  RoverParams params;
  params.geometry.rocker_limit_rad = params.geometry.bogie_limit_rad = math::DegToRad(1.0);
  params.drive.stall_torque_Nm = 100.0;  // two wheels hold the whole rover
  const Weights w(params);
  const RoverGeometry g = MakeRoverGeometry(params.geometry);
  const double axle_m = g.wheel_R[0].x();
  const double backward = std::atan((axle_m + w.com_x_m) / w.com_z_m);
  const double forward = std::atan((axle_m - w.com_x_m) / w.com_z_m);
  const double margin = math::DegToRad(2.0);
  EXPECT_LT(LeanAfter3s(params, backward - margin, kUphill), math::DegToRad(3.0));
  EXPECT_GT(LeanAfter3s(params, backward + margin, kUphill), math::DegToRad(10.0));
  EXPECT_LT(LeanAfter3s(params, forward - margin, kDownhill), math::DegToRad(3.0));
  EXPECT_GT(LeanAfter3s(params, forward + margin, kDownhill), math::DegToRad(10.0));
}

// Slip of the driving rover on slopes against the soil's curve.

// Firm enough for 30 deg.
terrain::SoilParams FirmSoil() {
  return terrain::SoilParams{.law = terrain::WheelLaw::kBekker,
                             .friction_angle_rad = math::DegToRad(45.0),
                             .shear_modulus_m = 0.002};
}

struct SlipCase {
  terrain::SoilParams soil = BekkerSoil();
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

TEST(Slip, FollowsTheCurveOfLandscapingSand) {
  for (const double slope_deg : {0.0, 5.0, 10.0, 15.0, 18.0})
    ExpectSlipOfTheCurve({BekkerSoil(), slope_deg});
}

TEST(Slip, FollowsTheCurveOfFirmSoilUpTo30Degrees) {
  for (const double slope_deg : {5.0, 10.0, 15.0, 20.0, 25.0, 30.0}) {
    ExpectSlipOfTheCurve({FirmSoil(), slope_deg});
  }
}

TEST(Slip, DoesNotDependOnSpeedOrStep) {
  for (const double speed_m_s : {0.0067, 0.05, 0.15}) {
    for (const double rate_Hz : {60.0, 120.0}) {
      ExpectSlipOfTheCurve({BekkerSoil(), 12.0, speed_m_s, rate_Hz});
    }
  }
}

TEST(Slip, FollowsTheCurveUnderMarsGravity) {
  ExpectSlipOfTheCurve({BekkerSoil(), 10.0, 0.15, 60.0, 3.72});
  ExpectSlipOfTheCurve({BekkerSoil(terrain::SoilPreset::kMarsDrift), 5.0, 0.0067, 60.0, 3.72});
}

// Near the largest traction a little more pull takes much more slip; wheels that share one slip
// must not take turns in pulling for that.
TEST(Slip, WheelsPullSteadilyNearTheLargestTraction) {
  const RoverParams params;
  terrain::SoilParams soil{.law = terrain::WheelLaw::kBekker, .shear_modulus_m = 0.001};
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
