// Rays with hits computed by hand.
#include <gtest/gtest.h>

#include "math/angles.h"
#include "terrain/placed_rocks.h"

namespace rockyard::terrain {
namespace {

using math::Vector3;

// Semi-axes 0.4, 0.2, 0.3 m, centre 0.1 m above flat ground at (2, 0).
Rock TestRock(double yaw_rad = 0.0) { return EllipsoidRock(2.0, 0.0, 0.1, 0.4, 0.2, 0.3, yaw_rad); }

class RayTest : public testing::Test {
 protected:
  const Terrain terrain_ = FlatWith({TestRock()});
};

using OccludedTest = RayTest;
using HeightTest = RayTest;
using RocksNearTest = RayTest;

TEST_F(RayTest, MeetsRockAlongItsAxes) {
  const auto hit = terrain_.CastRay({0, 0, 0.1}, Vector3::UnitX(), 5.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->surface, Surface::kRock);
  EXPECT_EQ(hit->rock, 0);
  EXPECT_NEAR(hit->distance_m, 1.6, 1e-12);
  EXPECT_NEAR((hit->normal_W + Vector3::UnitX()).norm(), 0.0, 1e-12);

  const auto from_above = terrain_.CastRay({2.0, 0.0, 1.0}, -Vector3::UnitZ(), 5.0);
  ASSERT_TRUE(from_above);
  EXPECT_NEAR(from_above->point_W.z(), 0.4, 1e-12);
  EXPECT_NEAR((from_above->normal_W - Vector3::UnitZ()).norm(), 0.0, 1e-12);
}

TEST_F(RayTest, YawTurnsTheRock) {
  const Terrain terrain = FlatWith({TestRock(math::DegToRad(90.0))});
  EXPECT_NEAR(terrain.CastRay({0, 0, 0.1}, Vector3::UnitX(), 5.0)->distance_m, 1.8, 1e-12);
  EXPECT_NEAR(terrain.CastRay({2, -2, 0.1}, Vector3::UnitY(), 5.0)->distance_m, 1.6, 1e-12);
}

// At yaw 45 deg the ray along x through the centre has half chord
// 1 / sqrt((cos^2 a) / a^2 + (sin^2 a) / b^2).
TEST_F(RayTest, ObliqueYaw) {
  const Terrain terrain = FlatWith({TestRock(math::DegToRad(45.0))});
  EXPECT_NEAR(terrain.CastRay({0, 0, 0.1}, Vector3::UnitX(), 5.0)->distance_m,
              2.0 - (1.0 / std::sqrt(0.5 / 0.16 + 0.5 / 0.04)), 1e-12);
}

TEST_F(RayTest, GroundHidesTheBuriedPart) {
  // Would meet the rock at z = -0.05, under the ground.
  const Vector3 origin(1.0, 0.0, 0.1);
  const Vector3 target(1.7, 0.0, -0.05);
  const auto hit = terrain_.CastRay(origin, (target - origin).normalized(), 5.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->surface, Surface::kGround);
  EXPECT_NEAR(hit->point_W.z(), 0.0, 1e-12);
}

TEST_F(RayTest, MaximumDistanceCounts) {
  EXPECT_FALSE(terrain_.CastRay({0, 0, 0.1}, Vector3::UnitX(), 1.5999));
  EXPECT_TRUE(terrain_.CastRay({0, 0, 0.1}, Vector3::UnitX(), 1.6001));
}

TEST_F(RayTest, AwayFromTheRockMisses) {
  EXPECT_FALSE(terrain_.CastRay({0, 0, 0.1}, -Vector3::UnitX(), 100.0));
  EXPECT_FALSE(terrain_.CastRay({0, 0.21, 0.1}, Vector3::UnitX(), 100.0));
  EXPECT_FALSE(terrain_.CastRay({0, 0, 0.41}, Vector3::UnitX(), 100.0));
}

TEST_F(RayTest, NearestOfSeveralRocksWins) {
  Rock far = TestRock();
  far.center_W.x() = 4.0;
  const Terrain terrain = FlatWith({far, TestRock()});
  EXPECT_EQ(terrain.CastRay({0, 0, 0.1}, Vector3::UnitX(), 9.0)->rock, 1);
  EXPECT_EQ(terrain.CastRay({9, 0, 0.1}, -Vector3::UnitX(), 9.0)->rock, 0);
}

TEST_F(RayTest, FromInsideARockHitsAtOnce) {
  const auto hit = terrain_.CastRay({2.0, 0.0, 0.2}, Vector3::UnitX(), 5.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->distance_m, 0.0);
  EXPECT_EQ(hit->surface, Surface::kRock);
  EXPECT_EQ(hit->normal_W, Vector3(-Vector3::UnitX()));
}

TEST_F(RayTest, WallsStopRaysFromInside) {
  const Terrain terrain(Ground(), {}, {{Vector3::UnitY(), 2.0}});
  const Vector3 direction = Vector3(1.0, 1.0, 0.0).normalized();
  const auto hit = terrain.CastRay({0, 0, 0.5}, direction, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->surface, Surface::kWall);
  EXPECT_NEAR(hit->distance_m, 2.0 * std::numbers::sqrt2, 1e-12);
  EXPECT_EQ(hit->normal_W, Vector3(-Vector3::UnitY()));
  EXPECT_FALSE(terrain.CastRay({0, 3, 0.5}, -Vector3::UnitY(), 10.0));
}

TEST_F(OccludedTest, RockBetweenTwoPoints) {
  EXPECT_TRUE(terrain_.Occluded({0, 0, 0.2}, {4, 0, 0.2}, 1e-6));
  EXPECT_FALSE(terrain_.Occluded({0, 0, 0.5}, {4, 0, 0.5}, 1e-6));
  EXPECT_FALSE(terrain_.Occluded({0, 0, 0.2}, {1.5, 0, 0.2}, 1e-6));
}

TEST_F(OccludedTest, EndsOnASurfaceAreVisible) {
  const Vector3 eye(0.0, 0.0, 0.3);
  const auto on_rock = terrain_.CastRay(eye, (Vector3(2, 0, 0.2) - eye).normalized(), 5.0);
  ASSERT_TRUE(on_rock);
  EXPECT_FALSE(terrain_.Occluded(eye, on_rock->point_W, 1e-6));
  EXPECT_FALSE(terrain_.Occluded(eye, {1.0, 0.0, 0.0}, 1e-6));
  EXPECT_TRUE(terrain_.Occluded(eye, {2.6, 0.0, 0.0}, 1e-6));  // the rock's shadow
}

TEST_F(OccludedTest, NothingFitsBetweenCoincidentPoints) {
  EXPECT_FALSE(terrain_.Occluded({2, 0, 0.2}, {2, 0, 0.2}, 1e-6));
}

TEST_F(HeightTest, RockTopOverItsOutlineAndGroundBeside) {
  EXPECT_NEAR(terrain_.Height(2.0, 0.0), 0.4, 1e-12);
  EXPECT_NEAR(terrain_.Height(2.2, 0.0), 0.1 + 0.3 * std::sqrt(0.75), 1e-12);
  EXPECT_EQ(terrain_.Height(2.41, 0.0), 0.0);
  EXPECT_EQ(terrain_.Height(2.0, 0.21), 0.0);
  EXPECT_EQ(terrain_.Height(1e9, -1e9), 0.0);
}

TEST_F(RocksNearTest, FindsByOutlineNotByCentre) {
  std::vector<int> near{99};
  terrain_.RocksNear(1.0, 0.0, 0.59, near);
  EXPECT_TRUE(near.empty());
  terrain_.RocksNear(1.0, 0.0, 0.61, near);
  EXPECT_EQ(near, std::vector<int>{0});
}

TEST(TerrainTest, WithoutRocks) {
  const Terrain terrain = FlatWith({});
  std::vector<int> near{1};
  terrain.RocksNear(0.0, 0.0, 10.0, near);
  EXPECT_TRUE(near.empty());
  EXPECT_EQ(terrain.Height(0.0, 0.0), 0.0);
  EXPECT_FALSE(terrain.CastRay({0, 0, 1}, Vector3::UnitX(), 100.0));
  EXPECT_NEAR(terrain.CastRay({0, 0, 1}, -Vector3::UnitZ(), 100.0)->distance_m, 1.0, 1e-15);
}

}  // namespace
}  // namespace rockyard::terrain
