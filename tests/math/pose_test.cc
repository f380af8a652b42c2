#include "math/pose.h"

#include <gtest/gtest.h>

namespace rockyard::math {
namespace {

Transform Pose(double yaw, double pitch, double roll) {
  Transform X_WR = Transform::Identity();
  X_WR.rotate(Eigen::AngleAxisd(yaw, Vector3::UnitZ()) *
              Eigen::AngleAxisd(pitch, Vector3::UnitY()) *
              Eigen::AngleAxisd(roll, Vector3::UnitX()));
  X_WR.pretranslate(Vector3(1.0, -2.0, 0.5));
  return X_WR;
}

TEST(PoseTest, HeadingIsTheYawWhateverPitchAndRollAre) {
  for (const double yaw : {-3.0, -0.5, 0.0, 1.2, 3.1}) {
    EXPECT_NEAR(Heading(Pose(yaw, 0.4, -0.3)), yaw, 1e-12);
  }
}

TEST(PoseTest, TiltIsTheAngleBetweenTheVerticals) {
  EXPECT_EQ(Tilt(Transform::Identity()), 0.0);
  EXPECT_NEAR(Tilt(Pose(0.7, 0.3, 0.0)), 0.3, 1e-12);
  EXPECT_NEAR(Tilt(Pose(-2.0, 0.0, -0.4)), 0.4, 1e-12);
  EXPECT_NEAR(Tilt(Pose(1.0, 0.3, 0.4)), std::acos(std::cos(0.3) * std::cos(0.4)), 1e-12);
  EXPECT_NEAR(Tilt(Pose(0.0, 0.0, std::numbers::pi)), std::numbers::pi, 1e-7);
}

TEST(PoseTest, PlanarPoseTakesPositionAndHeading) {
  const Pose2 pose = ToPose2(Pose(0.7, 0.1, 0.1));
  EXPECT_EQ(pose.x_m, 1.0);
  EXPECT_EQ(pose.y_m, -2.0);
  EXPECT_NEAR(pose.heading_rad, 0.7, 1e-12);
}

void ExpectNear(const Pose2& found, const Pose2& known) {
  EXPECT_NEAR(found.x_m, known.x_m, 1e-12);
  EXPECT_NEAR(found.y_m, known.y_m, 1e-12);
  EXPECT_NEAR(WrapAngle(found.heading_rad - known.heading_rad), 0.0, 1e-12);
}

// A quarter turn to the left takes what lies ahead to the left; headings stay within a half turn.
TEST(Pose2Test, ComposesByHand) {
  const double quarter_rad = 0.5 * std::numbers::pi;
  ExpectNear(Pose2{1.0, 2.0, quarter_rad} * Pose2{3.0, 1.0, 0.5}, {0.0, 5.0, quarter_rad + 0.5});
  const Pose2 back = Pose2{0.0, 0.0, 3.0} * Pose2{0.0, 0.0, 3.0};
  EXPECT_NEAR(back.heading_rad, 6.0 - 2.0 * std::numbers::pi, 1e-12);
}

TEST(Pose2Test, WhatIsSeenFromAPoseComposesToWhatItWas) {
  const Pose2 X_AB{1.5, -0.3, 2.1};
  const Pose2 X_AC{-2.0, 0.7, -1.4};
  ExpectNear(X_AB * SeenFrom(X_AB, X_AC), X_AC);
  // Carried along from A to another frame, C keeps its place beside B.
  const Pose2 X_DB{40.0, 30.0, -2.9};
  ExpectNear(SeenFrom(X_DB, Carried(X_DB, X_AB, X_AC)), SeenFrom(X_AB, X_AC));
  ExpectNear(TurnedAbout(X_AC, 1.0, 1.0, 0.4), Carried({1.0, 1.0, 0.4}, {1.0, 1.0, 0.0}, X_AC));
}

}  // namespace
}  // namespace rockyard::math
