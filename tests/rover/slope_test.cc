// The rover on slopes against closed forms.
#include <gtest/gtest.h>

#include <numbers>

#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

constexpr double kUphill = 0.0;
constexpr double kLeftUp = std::numbers::pi / 2;

// Distance along the ground, 3-D, from one position to another.
double Moved(const math::Vector3& from, const truth::RoverState& state) {
  return (state.X_WR.translation() - from).norm();
}

// Wheels of one rigid rover share one slip: their tractions at it add up to weight and resistance.
TEST(Slope, SlipFollowsTheSlipCurve) {
  for (const double slope_deg : {5.0, 10.0, 15.0, 20.0}) {
    const RoverParams params;
    const double slope = math::DegToRad(slope_deg);
    const terrain::Terrain terrain = SlopeTerrain(slope, kUphill);
    const auto rover = MakeRover(params, terrain);
    rover->Place({});
    const messages::WheelCommand command = Drive(params, 0.15, 0.0);
    RunFor(*rover, command, 3.0);
    const math::Vector3 from = rover->state().X_WR.translation();
    RunFor(*rover, command, 6.0);
    const SoilReference soil;
    const messages::PerWheel<double>& loads_N = rover->state().wheel_load_N;
    const double pull_N = Weights(params).total_N * std::sin(slope) + soil.SumResistance(loads_N);
    const double expected = soil.SlipForPull(pull_N, loads_N);
    const double slip = 1.0 - Moved(from, rover->state()) / 0.9;
    EXPECT_NEAR(slip, expected, 0.02 * expected + 0.001) << slope_deg;
  }
}

TEST(Slope, SlipDoesNotDependOnTheStep) {
  double slip[2];
  for (int i = 0; i < 2; ++i) {
    RoverParams params;
    params.physics.step_s = i == 0 ? 1.0 / 60.0 : 1.0 / 240.0;
    const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(15.0), kUphill);
    const auto rover = MakeRover(params, terrain);
    rover->Place({});
    const messages::WheelCommand command = Drive(params, 0.15, 0.0);
    RunFor(*rover, command, 2.0);
    const math::Vector3 from = rover->state().X_WR.translation();
    RunFor(*rover, command, 4.0);
    slip[i] = 1.0 - Moved(from, rover->state()) / 0.6;
  }
  EXPECT_NEAR(slip[0], slip[1], 0.002);
}

TEST(Slope, BrakedRoverSlidesBeyondTheFrictionAngle) {
  for (const double direction : {kUphill, kLeftUp}) {
    for (const double excess_deg : {-1.0, 1.0}) {
      const RoverParams params;
      const double slope = std::atan(0.5) + math::DegToRad(excess_deg);
      const terrain::Terrain terrain = SlopeTerrain(slope, direction, RigidGround(0.5));
      const auto rover = MakeRover(params, terrain);
      rover->Place({});
      const math::Vector3 from = rover->state().X_WR.translation();
      RunFor(*rover, kBraked, 2.0);
      if (excess_deg < 0.0) {
        EXPECT_LT(Moved(from, rover->state()), 1e-3);
      } else {
        // Half g (sin - friction cos) t^2.
        const double fall_m = 0.5 * 9.81 * (std::sin(slope) - 0.5 * std::cos(slope)) * 4.0;
        EXPECT_NEAR(Moved(from, rover->state()), fall_m, 0.05 * fall_m);
      }
    }
  }
}

// It tips about the lower wheels, somewhere between their middle and their outer edge.
TEST(Slope, TipsOverSidewaysAtTheStaticAngle) {
  const RoverParams params;
  const double middle_y = 0.5 * (params.geometry.width_m - params.geometry.wheel_width_m);
  const double edge_y = 0.5 * params.geometry.width_m;
  const double height = Weights(params).com_z_m;
  const auto tilt_after = [&](double slope) {
    const terrain::Terrain terrain = SlopeTerrain(slope, kLeftUp, RigidGround(3.0));
    const auto rover = MakeRover(params, terrain);
    rover->Place({});
    double lean = 0.0;
    for (int i = 0; i < 180 && lean < math::DegToRad(35.0); ++i) {
      lean = math::Tilt(rover->state().X_WR) - slope;
      rover->Step(kBraked);
    }
    return lean;
  };
  EXPECT_LT(tilt_after(std::atan(middle_y / height) - math::DegToRad(1.0)), math::DegToRad(3.0));
  EXPECT_GT(tilt_after(std::atan(edge_y / height) + math::DegToRad(1.0)), math::DegToRad(30.0));
}

TEST(Slope, RestsWithoutCreepOrEnergy) {
  const RoverParams params;
  const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(12.0), 0.7);
  const auto rover = MakeRover(params, terrain);
  rover->Place({});
  RunFor(*rover, kBraked, 5.0);
  const math::Vector3 from = rover->state().X_WR.translation();
  double fastest_m_s = 0.0;
  for (int i = 0; i < 3600; ++i) {
    rover->Step(kBraked);
    fastest_m_s = std::max(fastest_m_s, rover->state().v_WR_m_s.norm());
  }
  EXPECT_LT(fastest_m_s, 1e-4);
  EXPECT_LT(Moved(from, rover->state()), 1e-4);
}

}  // namespace
}  // namespace rockyard::rover
