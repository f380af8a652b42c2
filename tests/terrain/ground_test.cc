#include "terrain/ground.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "math/angles.h"
#include "terrain/arena.h"
#include "terrain/relief.h"

namespace rockyard::terrain {
namespace {

using math::Vector3;

constexpr core::TrialKey kKey{7, 3};

TEST(GroundTest, FlatByDefault) {
  const Ground ground;
  EXPECT_TRUE(ground.IsPlane());
  EXPECT_EQ(ground.Height(3.0, -2.0), 0.0);
  EXPECT_EQ(ground.Normal(3.0, -2.0), Vector3::UnitZ());
}

TEST(GroundTest, SlopeRisesAlongItsDirection) {
  GroundParams params{.slope_rad = math::DegToRad(20.0),
                      .slope_direction_rad = math::DegToRad(90.0)};
  const Ground ground(params, kKey);
  EXPECT_TRUE(ground.IsPlane());
  EXPECT_NEAR(ground.Height(5.0, 2.0), 2.0 * std::tan(params.slope_rad), 1e-12);
  const Vector3 expected(0.0, -std::sin(params.slope_rad), std::cos(params.slope_rad));
  EXPECT_NEAR((ground.Normal(1.0, 1.0) - expected).norm(), 0.0, 1e-12);
}

TEST(GroundTest, RayMeetsPlaneWhereComputedByHand) {
  GroundParams params;
  params.slope_rad = math::DegToRad(45.0);  // z = x
  const Ground ground(params, kKey);
  // From 1 m above the origin along +x: the plane is met at x = 1.
  EXPECT_NEAR(*ground.CastRay({0, 0, 1}, Vector3::UnitX(), 2.0), 1.0, 1e-12);
  EXPECT_FALSE(ground.CastRay({0, 0, 1}, Vector3::UnitX(), 0.999));
  EXPECT_FALSE(ground.CastRay({0, 0, 1}, -Vector3::UnitX(), 100.0));
}

TEST(GroundTest, RayAlongAPlaneMisses) {
  EXPECT_FALSE(Ground().CastRay({0, 0, 0.1}, Vector3::UnitX(), 1e6));
}

TEST(GroundTest, RayFromBelowHitsAtOnce) {
  EXPECT_EQ(*Ground().CastRay({0, 0, -0.1}, Vector3::UnitZ(), 1.0), 0.0);
}

class RoughGroundTest : public testing::Test {
 protected:
  static GroundParams Params() {
    return GroundParams{.slope_rad = math::DegToRad(5.0), .roughness_rms_m = 0.05};
  }
  const Ground ground_{Params(), kKey};
};

TEST_F(RoughGroundTest, IsNoPlane) {
  EXPECT_FALSE(ground_.IsPlane());
  EXPECT_NE(ground_.Height(1.0, 0.0), ground_.Height(0.0, 1.0));
}

TEST_F(RoughGroundTest, NormalIsTheGradientOfTheHeight) {
  constexpr double kStep_m = 1e-5;
  for (int i = 0; i < 200; ++i) {
    const double x = -3.0 + 0.071 * i;
    const double y = 2.0 - 0.043 * i;
    const Vector3 normal = ground_.Normal(x, y);
    const double dx = (ground_.Height(x + kStep_m, y) - ground_.Height(x - kStep_m, y)) / kStep_m;
    const double dy = (ground_.Height(x, y + kStep_m) - ground_.Height(x, y - kStep_m)) / kStep_m;
    EXPECT_NEAR(-normal.x() / normal.z(), 0.5 * dx, 1e-6);
    EXPECT_NEAR(-normal.y() / normal.z(), 0.5 * dy, 1e-6);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
  }
}

// Neither height nor slope jumps where the lattice cells of any octave meet.
TEST_F(RoughGroundTest, IsSmoothAcrossCells) {
  constexpr double kStep_m = 1e-7;
  for (int i = -40; i <= 40; ++i) {
    const double x = 0.03125 * i;  // every node line of the finest octave, 2 m / 2^5 / 2
    EXPECT_NEAR(ground_.Height(x - kStep_m, 0.3), ground_.Height(x + kStep_m, 0.3), 1e-6);
    const Vector3 before = ground_.Normal(x - kStep_m, 0.3);
    EXPECT_NEAR((before - ground_.Normal(x + kStep_m, 0.3)).norm(), 0.0, 1e-5);
  }
}

TEST_F(RoughGroundTest, EveryRayHitLiesOnTheGround) {
  int hits = 0;
  for (int i = 0; i < 100; ++i) {
    const Vector3 origin(0.1 * i, 0.05 * i, ground_.Height(0.1 * i, 0.05 * i) + 0.3);
    const Vector3 direction = Vector3(std::cos(i), std::sin(i), -0.4).normalized();
    const auto distance = ground_.CastRay(origin, direction, 5.0);
    if (!distance) continue;
    ++hits;
    const Vector3 point = origin + *distance * direction;
    EXPECT_NEAR(point.z(), ground_.Height(point.x(), point.y()), 1e-9);
  }
  EXPECT_GT(hits, 90);
}

// What the march of rays relies on: bounds hold, and are of the size of what occurs.
TEST(RoughnessFieldTest, BoundsHoldEverywhere) {
  constexpr double kStep_m = 1e-4;
  const RoughnessField field(0.05, 0.8, 2.0, kKey);
  double height = 0.0, slope = 0.0, curvature = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double x = 0.0237 * (i % 200);
    const double y = 0.0229 * (i / 200);
    const ReliefSample at = field.Sample(x, y);
    const ReliefSample ahead = field.Sample(x + kStep_m, y);
    height = std::max(height, std::abs(at.height_m));
    slope = std::max(slope, std::hypot(at.slope_x, at.slope_y));
    curvature = std::max(
        curvature, std::hypot(ahead.slope_x - at.slope_x, ahead.slope_y - at.slope_y) / kStep_m);
  }
  EXPECT_LE(height, field.bounds().height_m);
  EXPECT_LE(slope, field.bounds().slope);
  EXPECT_LE(curvature, field.bounds().curvature_per_m);
  EXPECT_GT(height, 0.1 * field.bounds().height_m);
  EXPECT_GT(slope, 0.1 * field.bounds().slope);
  EXPECT_GT(curvature, 0.1 * field.bounds().curvature_per_m);
}

TEST_F(RoughGroundTest, AnotherTrialHasAnotherGround) {
  const Ground other(Params(), {7, 4});
  EXPECT_NE(ground_.Height(1.0, 1.0), other.Height(1.0, 1.0));
  const Ground same(Params(), kKey);
  EXPECT_EQ(ground_.Height(1.0, 1.0), same.Height(1.0, 1.0));
}

ArenaParams Arena(ArenaKind kind) { return ArenaParams{.kind = kind}; }

Rock RockAt(double y_m, double yaw_rad) {
  return Rock{.center_W = {3.0, y_m, 0.05}, .yaw_rad = yaw_rad};
}

TEST(ArenaTest, DefaultsAreThePaperArena) {
  EXPECT_DOUBLE_EQ(ArenaBounds({}).Area(), 48.0);
  EXPECT_NEAR(2.0 * ArenaParams().MirrorLine(), 2.2, 1e-12);
  EXPECT_NEAR(CountArea({}).Area(), 17.6, 1e-12);
}

TEST(ArenaTest, OnlyTheWalledOneHasWalls) {
  EXPECT_TRUE(ArenaWalls(Arena(ArenaKind::kOpen)).empty());
  EXPECT_TRUE(ArenaWalls(Arena(ArenaKind::kVirtualReflected)).empty());
  const std::vector<Wall> walls = ArenaWalls(Arena(ArenaKind::kWalled));
  ASSERT_EQ(walls.size(), 4u);
  // A point in the arena is inside every wall, one beyond each edge is outside of just one.
  const auto outside = [&walls](const math::Vector3& p) {
    int count = 0;
    for (const Wall& wall : walls) count += wall.normal_W.dot(p) >= wall.offset_m ? 1 : 0;
    return count;
  };
  EXPECT_EQ(outside({-1.99, 1.99, 0.0}), 0);
  EXPECT_EQ(outside({9.99, -1.99, 0.0}), 0);
  EXPECT_EQ(outside({-2.01, 0.0, 0.0}), 1);
  EXPECT_EQ(outside({10.01, 0.0, 0.0}), 1);
  EXPECT_EQ(outside({0.0, 2.01, 0.0}), 1);
  EXPECT_EQ(outside({0.0, -2.01, 0.0}), 1);
}

TEST(ArenaTest, DrivableBounds) {
  EXPECT_DOUBLE_EQ(DrivableBounds(Arena(ArenaKind::kOpen)).y_max_m, 6.0);
  EXPECT_DOUBLE_EQ(DrivableBounds(Arena(ArenaKind::kWalled)).y_max_m, 2.0);
  EXPECT_DOUBLE_EQ(DrivableBounds(Arena(ArenaKind::kVirtualReflected)).y_max_m, 2.0);
  EXPECT_NEAR(DrivableBounds(Arena(ArenaKind::kVirtualUnfolded)).y_max_m, 5.5, 1e-12);
}

TEST(MirrorImagesTest, ReflectedKeepsImagesWithinTheArena) {
  const ArenaParams arena = Arena(ArenaKind::kVirtualReflected);
  const std::vector<Rock> upper = MirrorImages(arena, RockAt(0.5, 0.3));
  ASSERT_EQ(upper.size(), 1u);
  EXPECT_NEAR(upper[0].center_W.y(), 1.7, 1e-12);  // 2 x 1.1 - 0.5
  EXPECT_DOUBLE_EQ(upper[0].yaw_rad, -0.3);
  EXPECT_TRUE(MirrorImages(arena, RockAt(0.1, 0.3)).empty());  // its image would be at 2.1
}

TEST(MirrorImagesTest, UnfoldedIsMirrorPeriodic) {
  const std::vector<Rock> images =
      MirrorImages(Arena(ArenaKind::kVirtualUnfolded), RockAt(0.5, 0.3));
  ASSERT_EQ(images.size(), 4u);
  const double expected_y_m[] = {-3.9, -2.7, 1.7, 4.9};
  const double expected_yaw_rad[] = {0.3, -0.3, -0.3, 0.3};
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_NEAR(images[i].center_W.y(), expected_y_m[i], 1e-12);
    EXPECT_DOUBLE_EQ(images[i].yaw_rad, expected_yaw_rad[i]);
    EXPECT_DOUBLE_EQ(images[i].center_W.x(), 3.0);
  }
}

TEST(MirrorImagesTest, OtherArenasHaveNone) {
  EXPECT_TRUE(MirrorImages(Arena(ArenaKind::kOpen), RockAt(0.5, 0.0)).empty());
  EXPECT_TRUE(MirrorImages(Arena(ArenaKind::kWalled), RockAt(0.5, 0.0)).empty());
}

TEST(HoldsCoursePointTest, VirtualArenasWantTheStrip) {
  EXPECT_TRUE(Arena(ArenaKind::kWalled).HoldsCoursePoint(0.0, 1.5));
  EXPECT_FALSE(Arena(ArenaKind::kVirtualReflected).HoldsCoursePoint(0.0, 1.5));
  EXPECT_FALSE(Arena(ArenaKind::kOpen).HoldsCoursePoint(10.5, 0.0));
}

}  // namespace
}  // namespace rockyard::terrain
