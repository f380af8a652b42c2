// Holding forces against the numbers of a pocket calculator.
#include <gtest/gtest.h>

#include <numbers>

#include "terrain/placed_rocks.h"
#include "terrain/rock.h"

namespace rockyard::terrain {
namespace {

constexpr double kEarth_m_s2 = 9.81;

// An ellipsoid of 2 a x 2 b x 2 c, buried to a depth of depth_m.
Rock MakeRock(double a_m, double b_m, double c_m, double depth_m) {
  return EllipsoidRock(0.0, 0.0, c_m - depth_m, a_m, b_m, c_m);
}

TEST(RockHolding, MassIsThatOfTheEllipsoid) {
  EXPECT_NEAR(RockMass(MakeRock(0.1, 0.1, 0.1, 0.0), 2700.0), 11.310, 1e-3);
  EXPECT_NEAR(RockMass(MakeRock(0.2, 0.1, 0.05, 0.0), 2700.0), 11.310, 1e-3);
}

TEST(RockHolding, UnburiedRockIsHeldByFrictionUnderWeightAndLoad) {
  const RockHoldingParams params;
  const Rock rock = MakeRock(0.1, 0.1, 0.1, 0.0);
  const double weight_N = 11.3097 * kEarth_m_s2;
  const auto force = [&](double load_N) {
    return HoldingForce(rock, params, kEarth_m_s2, load_N, math::Vector3::UnitX());
  };
  EXPECT_NEAR(force(0.0), 0.6 * weight_N, 1e-3);
  EXPECT_NEAR(force(50.0), 0.6 * (weight_N + 50.0), 1e-3);
  EXPECT_NEAR(force(-50.0), 0.6 * (weight_N - 50.0), 1e-3);
  EXPECT_EQ(force(-2.0 * weight_N), 0.0);  // lifted
}

// Rankine: K = 3 at 30 degrees. Half of 3 x 1600 x 9.81 N/m3 x (0.1 m)^2 x 0.3 m is 70.63 N.
TEST(RockHolding, BuriedRockIsAlsoHeldByThePassivePressureOnItsFront) {
  RockHoldingParams params{.soil_friction_angle_rad = math::DegToRad(30.0),
                           .rock_soil_friction = 0.0};
  const auto force = [&](double depth_m, const math::Vector3& push_W) {
    return HoldingForce(MakeRock(0.15, 0.1, 0.15, depth_m), params, kEarth_m_s2, 0.0, push_W);
  };
  EXPECT_NEAR(force(0.1, math::Vector3::UnitY()), 70.63, 0.01);
  EXPECT_NEAR(force(0.1, math::Vector3::UnitX()), 70.63 * 2.0 / 3.0, 0.01);  // 0.2 m wide
  EXPECT_NEAR(force(0.2, math::Vector3::UnitY()), 4.0 * 70.63, 0.04);
  EXPECT_EQ(force(0.0, math::Vector3::UnitY()), 0.0);
}

TEST(RockHolding, WidthFollowsTheRocksYaw) {
  RockHoldingParams params{.rock_soil_friction = 0.0};
  Rock rock = MakeRock(0.15, 0.1, 0.15, 0.1);
  const double across_N =
      HoldingForce(rock, params, kEarth_m_s2, 0.0, 7.0 * math::Vector3::UnitY());
  rock.yaw_rad = 0.5 * std::numbers::pi;
  EXPECT_NEAR(HoldingForce(rock, params, kEarth_m_s2, 0.0, -math::Vector3::UnitX()), across_N,
              1e-9);
}

}  // namespace
}  // namespace rockyard::terrain
