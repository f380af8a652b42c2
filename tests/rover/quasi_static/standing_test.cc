// The quasi-static rover with its brakes on: what holds it, what does not, and how it drives on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rover/quasi_static/quasi_static_rover.h"
#include "rover/rover_drive.h"

namespace rockyard::rover {
namespace {

RoverParams QuasiStatic(double ramp_s) {
  RoverParams params = WithFidelity(Fidelity::kQuasiStatic);
  params.drive.ramp_s = ramp_s;
  return params;
}

// Slippery ground: brakes hold on slopes up to the angle of friction, and not half a degree beyond
// it.
TEST(QuasiStaticStanding, SlidesOffSlipperyGroundBeyondItsAngleOfFriction) {
  for (const double friction : {0.1, 0.2}) {
    for (const double excess_deg : {-1.0, -0.2, 0.5, 1.0}) {
      const double slope = std::atan(friction) + math::DegToRad(excess_deg);
      const terrain::Terrain terrain =
          SlopeTerrain(slope, 0.5 * std::numbers::pi, RigidGround(friction));
      const auto rover = PlacedRover(QuasiStatic(0.1), terrain);
      const math::Vector3 from = rover->state().X_WR.translation();
      RunFor(*rover, kBraked, 1.0);
      const math::Vector3 moved = rover->state().X_WR.translation() - from;
      if (excess_deg < 0.0) {
        EXPECT_LT(moved.norm(), 1e-4) << friction << ", " << excess_deg;
      } else {
        EXPECT_LT(moved.y(), -0.05) << friction;
      }
    }
  }
}

// Over an edge of 20 cm the rover falls wheel by wheel. Whenever it brakes, it hangs nowhere: what
// it stands on bears its weight, but for the slant of the edge.
TEST(QuasiStaticStanding, HangsNowhereWhenItBrakesOverAnEdge) {
  const RoverParams params = QuasiStatic(0.1);
  const terrain::Terrain terrain = StepTerrain(0.2);
  const double weight_N = Weights(params).total_N;
  for (int steps = 85; steps < 105; ++steps) {
    const auto rover = PlacedRover(params, terrain, {1.2, 0.0, 0.0});
    for (int i = 0; i < steps; ++i) rover->Step(Drive(params, 0.15, 0.0));
    RunFor(*rover, kBraked, 1.0);
    double borne_N = 0.0;
    for (const double load_N : rover->state().wheel_load_N) borne_N += load_N;
    for (const truth::BodyContact& contact : rover->state().contacts) {
      borne_N += contact.normal_force_N;
    }
    EXPECT_GT(borne_N, 0.85 * weight_N) << steps;
  }
}

// Where brakes hold by a narrow margin, each stop has a balance of its own. When the wheels turn
// again, the velocity that the rover reports is still what its position changes by.
TEST(QuasiStaticStanding, ReportsTheVelocityOfItsMotionAfterAStopOnASlope) {
  for (const double friction : {0.1, 0.2, 0.5}) {
    const RoverParams params = QuasiStatic(0.1);
    const terrain::Terrain terrain =
        SlopeTerrain(0.96 * std::atan(friction), 0.0, RigidGround(friction));
    const auto rover = PlacedRover(params, terrain);
    const messages::WheelCommand drive = Drive(params, 0.07, 0.0);
    for (int stop = 0; stop < 5; ++stop) {
      RunFor(*rover, drive, 0.2);
      const math::Vector3 from = rover->state().X_WR.translation();
      rover->Step(drive);
      const math::Vector3 mean_m_s = (rover->state().X_WR.translation() - from) / rover->step_s();
      ASSERT_GT(mean_m_s.norm(), 2e-3);
      EXPECT_NEAR((rover->state().v_WR_m_s - mean_m_s).norm(), 0.0, 0.3 * mean_m_s.norm())
          << friction << ", stop " << stop;
      RunFor(*rover, kBraked, 0.3);
    }
  }
}

// Where friction holds it with ease a stop asks for no balance, nor do ramps: there is one for each
// stretch of rim travel, on straight drives and arcs, and two of them at the first start.
TEST(QuasiStaticStanding, StopsOnGentleSlopesTakeNoBalanceOfTheirOwn) {
  for (const double slope_deg : {10.0, 15.0}) {
    const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(slope_deg), 1.0);
    for (const double ramp_s : {0.05, 0.1, 0.23}) {
      for (const double turn_rad_s : {0.0, 0.1}) {
        const RoverParams params = QuasiStatic(ramp_s);
        QuasiStaticRover rover(params, terrain);
        rover.Place({});
        const messages::WheelCommand drive = Drive(params, 0.1, turn_rad_s);
        RunFor(rover, SteerOnly(drive), 1.0);
        const std::int64_t before = rover.work().balances;
        for (int stop = 0; stop < 10; ++stop) {
          RunFor(rover, drive, 0.4);
          RunFor(rover, SteerOnly(drive), ramp_s + 0.05);
        }
        double farthest_rad = 0.0;
        for (const double angle_rad : rover.state().wheel_angle_rad) {
          farthest_rad = std::max(farthest_rad, angle_rad);
        }
        const double stretches =
            farthest_rad * params.geometry.wheel_radius_m / params.quasi_static.settle_distance_m;
        EXPECT_LE(static_cast<double>(rover.work().balances - before), stretches + 2.0)
            << slope_deg << " deg, ramp " << ramp_s << ", turn " << turn_rad_s;
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::rover
