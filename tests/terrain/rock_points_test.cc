// Points of rocks for drawings against the queries of the terrain.
#include <gtest/gtest.h>

#include <algorithm>

#include "terrain/rock.h"

namespace rockyard::terrain {
namespace {

constexpr double kGround_m = 0.3;

// Turned, three quarters as wide as long, and with that height above the ground.
Rock Standing(double pointedness) {
  Rock rock =
      ShapeRock({.diameter_m = 0.6, .width_ratio = 0.75, .half_height_m = 0.2, .height_m = 0.28},
                pointedness);
  rock.center_W += math::Vector3(4.0, -2.0, kGround_m);
  rock.yaw_rad = 0.7;
  return rock;
}

TEST(RockPoints, LieOnTheSurfaceFromTheGroundToTheTop) {
  for (const double pointedness : {0.0, 0.5, 0.9}) {
    const Rock rock = Standing(pointedness);
    const RockShape shape(rock);
    double lowest_m = 1e9;
    double highest_m = -1e9;
    for (const math::Vector3& point : PointsAbove(rock, kGround_m)) {
      lowest_m = std::min(lowest_m, point.z());
      highest_m = std::max(highest_m, point.z());
      if (point.z() < rock.center_W.z() + 1e-9) continue;  // an ellipsoid's lower half
      // A little inwards, where the query is not beside the rock.
      const math::Vector3 within = point + 1e-9 * (rock.center_W - point);
      EXPECT_NEAR(shape.Top(within.x(), within.y()), point.z(), 1e-3) << pointedness;
    }
    EXPECT_NEAR(lowest_m, kGround_m, 1e-12) << pointedness;
    EXPECT_NEAR(highest_m, kGround_m + rock.height_m, 1e-12) << pointedness;
  }
}

// (p / semi-axes)^2 adds up to 1 on all of an ellipsoid.
TEST(RockPoints, TheLowerHalfOfAnEllipsoidIsOnItToo) {
  const Rock rock = Standing(0.0);
  const RockShape shape(rock);
  for (const math::Vector3& point : PointsAbove(rock, kGround_m)) {
    EXPECT_NEAR(shape.Map(point - rock.center_W).norm(), 1.0, 1e-12);
  }
}

TEST(RockPoints, NothingOfABuriedRock) {
  const Rock rock = Standing(0.0);
  EXPECT_TRUE(PointsAbove(rock, kGround_m + rock.height_m + 0.01).empty());
  EXPECT_FALSE(PointsAbove(rock, kGround_m + rock.height_m - 0.01).empty());
}

TEST(RockPoints, TheOutlineIsAnOctagonOfTheEllipse) {
  const Rock rock = Standing(0.0);
  const std::vector<math::Vector3> outline = PlanOutline(rock);
  ASSERT_EQ(outline.size(), 8u);
  const RockShape shape(rock);
  for (const math::Vector3& corner : outline) {
    EXPECT_NEAR(shape.Map(corner - rock.center_W).norm(), 1.0, 1e-12);
    EXPECT_EQ(corner.z(), rock.center_W.z());
  }
}

}  // namespace
}  // namespace rockyard::terrain
