#include "perception/slip_check.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rockyard::perception {
namespace {

using messages::Index;
using messages::PoseCoordinate;

messages::RelativeMotion Seen(double x_m, double y_m, double sd_x_m, double sd_y_m) {
  messages::RelativeMotion motion;
  motion.motion_F[Index(PoseCoordinate::kX)] = x_m;
  motion.motion_F[Index(PoseCoordinate::kY)] = y_m;
  motion.covariance(0, 0) = sd_x_m * sd_x_m;
  motion.covariance(1, 1) = sd_y_m * sd_y_m;
  return motion;
}

constexpr SlipCheckParams kParams{.enabled = true, .limit = 0.5, .sigma = 2.0, .min_way_m = 0.2};

TEST(SlipCheckTest, IsTheShareOfTheWayThatIsLost) {
  const auto slip = SlipOf({0.5, 0.0}, Seen(0.2, 0.1, 0.01, 0.3), kParams);
  ASSERT_TRUE(slip);
  EXPECT_NEAR(slip->slip, 0.6, 1e-12);
  EXPECT_NEAR(slip->sd, 0.02, 1e-12);
  EXPECT_TRUE(slip->exceeded);  // 0.6 - 0.04 > 0.5
}

TEST(SlipCheckTest, AsksForAsManyStandardDeviations) {
  EXPECT_FALSE(SlipOf({0.5, 0.0}, Seen(0.2, 0.0, 0.026, 0.0), kParams)->exceeded);
  EXPECT_TRUE(SlipOf({0.5, 0.0}, Seen(0.2, 0.0, 0.024, 0.0), kParams)->exceeded);
}

// Backwards and aslant: along the way that was rolled.
TEST(SlipCheckTest, GoesAlongTheWayOfTheWheels) {
  const auto back = SlipOf({-0.5, 0.0}, Seen(-0.4, 0.0, 0.0, 0.0), kParams);
  EXPECT_NEAR(back->slip, 0.2, 1e-12);
  const auto aslant = SlipOf({0.3, 0.4}, Seen(0.3, 0.4, 0.01, 0.02), kParams);
  EXPECT_NEAR(aslant->slip, 0.0, 1e-12);
  EXPECT_NEAR(aslant->sd, std::hypot(0.6 * 0.01, 0.8 * 0.02) / 0.5, 1e-12);
  // Seen to slide on, and to the side.
  EXPECT_NEAR(SlipOf({0.5, 0.0}, Seen(0.6, 0.3, 0.0, 0.0), kParams)->slip, -0.2, 1e-12);
}

TEST(SlipCheckTest, ShortWaysTellNothing) {
  EXPECT_FALSE(SlipOf({0.19, 0.0}, Seen(0.0, 0.0, 0.0, 0.0), kParams));
  EXPECT_TRUE(SlipOf({0.21, 0.0}, Seen(0.0, 0.0, 0.0, 0.0), kParams));
  EXPECT_FALSE(SlipOf({0.0, 0.0}, Seen(0.0, 0.0, 0.0, 0.0), kParams));
}

TEST(SlipCheckTest, TheRolledWayLiesAlongTheFirstHeading) {
  const messages::PoseEstimate from{.x_m = 1.0, .y_m = 2.0, .heading_rad = std::asin(0.6)};
  const messages::PoseEstimate to{
      .x_m = 1.0 + 0.8 - 0.6, .y_m = 2.0 + 0.6 + 0.8, .heading_rad = 3.0};
  const Eigen::Vector2d way = RolledWay(from, to);
  EXPECT_NEAR(way.x(), 1.0, 1e-12);
  EXPECT_NEAR(way.y(), 1.0, 1e-12);
}

}  // namespace
}  // namespace rockyard::perception
