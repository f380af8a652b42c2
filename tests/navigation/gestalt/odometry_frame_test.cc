// The frame in which corrections move the world and not the rover.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "navigation/gestalt/gestalt.h"

namespace rockyard::navigation {
namespace {

using messages::Goal;
using messages::PoseEstimate;

constexpr double kRounding = 1e-12;

void ExpectNear(const PoseEstimate& a, const PoseEstimate& b) {
  EXPECT_NEAR(a.x_m, b.x_m, kRounding);
  EXPECT_NEAR(a.y_m, b.y_m, kRounding);
  EXPECT_NEAR(math::WrapAngle(a.heading_rad - b.heading_rad), 0.0, kRounding);
  EXPECT_EQ(a.distance_m, b.distance_m);
}

// Where a place lies as seen from a pose: ahead and to the left.
Goal SeenFrom(const PoseEstimate& pose, const Goal& place) {
  const double dx = place.x_m - pose.x_m;
  const double dy = place.y_m - pose.y_m;
  const double c = std::cos(pose.heading_rad);
  const double s = std::sin(pose.heading_rad);
  return {c * dx + s * dy, c * dy - s * dx};
}

TEST(OdometryFrame, IsTheWorldBeforeTheFirstCorrection) {
  const OdometryFrame frame;
  const PoseEstimate pose{1.25, -3.5, 2.0, 7.0};
  const PoseEstimate same = frame.FromWorld(pose);
  EXPECT_EQ(same.x_m, pose.x_m);
  EXPECT_EQ(same.y_m, pose.y_m);
  EXPECT_EQ(same.heading_rad, pose.heading_rad);
  EXPECT_EQ(same.distance_m, pose.distance_m);
}

// By hand: a quarter turn of the estimate to the left turns the world in O to the right.
TEST(OdometryFrame, AQuarterTurnByHand) {
  OdometryFrame frame;
  frame.Correct({1.0, 0.0, 0.0, 4.0}, {2.0, 3.0, 0.5 * std::numbers::pi, 4.0});
  // Where the rover was told to be, it is where it was.
  ExpectNear(frame.FromWorld(PoseEstimate{2.0, 3.0, 0.5 * std::numbers::pi, 4.0}),
             {1.0, 0.0, 0.0, 4.0});
  // A metre further north in W is a metre ahead of a rover that is told that it faces north.
  const Goal north = frame.FromWorld(Goal{2.0, 4.0});
  EXPECT_NEAR(north.x_m, 2.0, kRounding);
  EXPECT_NEAR(north.y_m, 0.0, kRounding);
}

TEST(OdometryFrame, CorrectionsKeepTheRoverAndMoveTheGoal) {
  OdometryFrame frame;
  PoseEstimate estimate{0.3, -0.2, 3.0, 1.0};
  const Goal goal{5.0, 2.0};
  for (int i = 1; i <= 20; ++i) {
    const PoseEstimate before = estimate;
    const PoseEstimate after{before.x_m + 0.1 * i, before.y_m - 0.07 * i,
                             math::WrapAngle(before.heading_rad + 0.4 * i), before.distance_m};
    const PoseEstimate stays = frame.FromWorld(before);
    frame.Correct(before, after);
    ExpectNear(frame.FromWorld(after), stays);
    // Seen from the rover the goal lies alike in both frames.
    const Goal in_W = SeenFrom(after, goal);
    const Goal in_O = SeenFrom(frame.FromWorld(after), frame.FromWorld(goal));
    EXPECT_NEAR(in_W.x_m, in_O.x_m, 1e-11);
    EXPECT_NEAR(in_W.y_m, in_O.y_m, 1e-11);
    estimate = after;
    estimate.x_m += 0.5;
    estimate.distance_m += 0.5;
  }
}

}  // namespace
}  // namespace rockyard::navigation
