// The rover on slopes against closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "rover/rover_params.h"
#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

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
    const terrain::SoilParams soil = terrain::MakeSoil(preset);
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
    const terrain::SoilParams soil = terrain::MakeSoil(preset);
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

}  // namespace
}  // namespace rockyard::rover
