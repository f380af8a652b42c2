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

}  // namespace
}  // namespace rockyard::math
