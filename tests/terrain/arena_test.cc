#include "terrain/arena.h"

#include <gtest/gtest.h>

#include <vector>

namespace rockyard::terrain {
namespace {

ArenaParams Arena(ArenaKind kind) { return ArenaParams{.kind = kind}; }

Rock RockAt(double y_m, double yaw_rad) {
  return Rock{.center_W = {3.0, y_m, 0.05}, .yaw_rad = yaw_rad};
}

TEST(ArenaTest, DefaultsAreThePaperArena) {
  const Rectangle bounds = ArenaBounds({});
  EXPECT_DOUBLE_EQ(bounds.Area(), 48.0);
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
