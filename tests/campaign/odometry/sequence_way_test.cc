// Ways of rendered sequences against circles and polygons.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "campaign/odometry/render_sequence.h"

namespace rockyard::campaign {
namespace {

using math::Pose2;

TEST(SequenceWay, ACircleClosesAfterAWholeTurn) {
  constexpr int kSteps = 36;
  const Pose2 start{1.0, 2.0, 0.3};
  const auto way = CircleWay(start, kSteps + 1, 0.5, 2.0 * std::numbers::pi / kSteps);
  ASSERT_EQ(way.size(), kSteps + 1u);
  EXPECT_NEAR(way.back().x_m, start.x_m, 1e-12);
  EXPECT_NEAR(way.back().y_m, start.y_m, 1e-12);
  // All lie on the circle whose circumference is that of the steps.
  const double radius_m = 0.5 * kSteps / (2.0 * std::numbers::pi);
  const double centre_x = start.x_m - radius_m * std::sin(start.heading_rad);
  const double centre_y = start.y_m + radius_m * std::cos(start.heading_rad);
  for (const Pose2& pose : way) {
    EXPECT_NEAR(std::hypot(pose.x_m - centre_x, pose.y_m - centre_y), radius_m, 1e-12);
  }
}

TEST(SequenceWay, StraightBackwardsAndStanding) {
  const auto back = CircleWay({1.0, 2.0, 0.5 * std::numbers::pi}, 3, -0.25, 0.0);
  EXPECT_NEAR(back[2].x_m, 1.0, 1e-12);
  EXPECT_NEAR(back[2].y_m, 1.5, 1e-12);
  const auto standing = CircleWay({1.0, 2.0, 0.5}, 4, 0.0, 0.0);
  EXPECT_EQ(standing.size(), 4u);
  EXPECT_EQ(standing[3].x_m, 1.0);
  const auto turning = CircleWay({1.0, 2.0, 0.5}, 2, 0.0, 0.1);
  EXPECT_EQ(turning[1].y_m, 2.0);
  EXPECT_DOUBLE_EQ(turning[1].heading_rad, 0.6);
}

// From the origin along x, then to the left: 1 m in steps of 0.4 m, a quarter turn in five.
TEST(SequenceWay, CornersAreTurnedAtAndReached) {
  const messages::Goal corners[] = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}};
  const auto way = CornerWay({}, corners, 100, 0.4, 0.4);
  ASSERT_EQ(way.size(), 1u + 3u + 4u + 2u);
  EXPECT_DOUBLE_EQ(way[1].x_m, 0.4);
  EXPECT_DOUBLE_EQ(way[3].x_m, 1.0);
  for (int i = 1; i <= 4; ++i) {
    const Pose2& turned = way[static_cast<std::size_t>(3 + i)];
    EXPECT_DOUBLE_EQ(turned.x_m, 1.0);
    EXPECT_NEAR(turned.heading_rad, i * std::numbers::pi / 8.0, 1e-12);
  }
  EXPECT_DOUBLE_EQ(way[8].y_m, 0.4);
  EXPECT_DOUBLE_EQ(way[9].y_m, 0.5);
  EXPECT_EQ(CornerWay({}, corners, 6, 0.4, 0.4).size(), 6u);
}

// Of a way of 1e300 steps, and of as many turns, the first ones.
TEST(SequenceWay, StepsThatAreNotWantedAreNotTaken) {
  const std::vector<messages::Goal> corners{{1.0, 0.0}, {1.0, 1.0}};
  const auto way = CornerWay({}, corners, 3, 1e-300, 0.4);
  ASSERT_EQ(way.size(), 3u);
  EXPECT_EQ(way[2].x_m, 2e-300);
  const auto turned = CornerWay({0.0, 0.0, 3.0}, corners, 3, 1.0, 1e-300);
  ASSERT_EQ(turned.size(), 3u);
  EXPECT_EQ(turned[2].x_m, 0.0);
}

TEST(SequenceWay, TurnsTakeTheShorterWayRound) {
  const messages::Goal behind[] = {{-1.0, -0.1}};
  const auto way = CornerWay({0.0, 0.0, 3.0}, behind, 100, 1.0, 0.2);
  // From 3 rad over pi to -3.04 rad: 0.24 rad, in two turns.
  ASSERT_EQ(way.size(), 1u + 2u + 2u);
  EXPECT_NEAR(way[1].heading_rad,
              3.0 + 0.5 * (2.0 * std::numbers::pi + std::atan2(-0.1, -1.0) - 3.0), 1e-12);
  // Steps that divide the way, but for rounding, make no further one.
  const messages::Goal ahead[] = {{0.3, 0.0}};
  EXPECT_EQ(CornerWay({}, ahead, 100, 0.1, 0.2).size(), 4u);
}

}  // namespace
}  // namespace rockyard::campaign
