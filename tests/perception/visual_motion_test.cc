#include "perception/visual_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "math/angles.h"
#include "math/pose.h"

namespace rockyard::perception {
namespace {

using math::Transform;
using math::Vector3;
using messages::Index;
using messages::PoseCoordinate;
using messages::PoseVector;

struct Pose {
  Vector3 p_W = Vector3::Zero();
  double heading_rad = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;

  Transform X_W() const { return math::MakePose(p_W, heading_rad, pitch_rad, roll_rad); }
};

constexpr double kHeading0_rad = 2.9;  // so that the second one lies beyond half a turn
const Pose kFirst{{3.0, -2.0, 0.4}, kHeading0_rad, 0.21, -0.13};
const Pose kSecond{{2.4, -1.5, 0.55}, kHeading0_rad + 0.5, 0.08, 0.17};

vision::Motion MotionBetween(const Pose& first, const Pose& second) {
  vision::Motion motion;
  motion.X_FS = first.X_W().inverse() * second.X_W();
  return motion;
}

FirstStance StanceOf(const Pose& pose) {
  return {{.roll_rad = pose.roll_rad, .pitch_rad = pose.pitch_rad}, 0.0};
}

// Differences of poses, the translation turned by the first heading.
PoseVector Expected(const Pose& first, const Pose& second) {
  const Vector3 d_W = second.p_W - first.p_W;
  const double c = std::cos(first.heading_rad);
  const double s = std::sin(first.heading_rad);
  PoseVector expected;
  expected << c * d_W.x() + s * d_W.y(), -s * d_W.x() + c * d_W.y(), d_W.z(),
      second.roll_rad - first.roll_rad, second.pitch_rad - first.pitch_rad,
      second.heading_rad - first.heading_rad;
  return expected;
}

TEST(VisualMotionTest, IsTheDifferenceOfTwoPosesInTheFirstLevelledFrame) {
  const messages::RelativeMotion levelled =
      LevelledMotion(MotionBetween(kFirst, kSecond), StanceOf(kFirst));
  EXPECT_LT((levelled.motion_F - Expected(kFirst, kSecond)).norm(), 1e-12);
}

TEST(VisualMotionTest, StandingStillIsNoMotion) {
  const messages::RelativeMotion levelled =
      LevelledMotion(MotionBetween(kFirst, kFirst), StanceOf(kFirst));
  EXPECT_LT(levelled.motion_F.norm(), 1e-12);
}

// Covariance by differences: X_FS disturbed by each of its six errors.
TEST(VisualMotionTest, TheCovarianceIsThatOfDisturbedMotions) {
  vision::Motion motion = MotionBetween(kFirst, kSecond);
  messages::PoseCovariance by_error;
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    const auto disturbed = [&](double step) {
      vision::Motion other = motion;
      if (i < 3) {
        other.X_FS.translation()[i] += step;
      } else {
        const Eigen::AngleAxisd turn(step, Vector3::Unit(i - 3));
        other.X_FS.linear() = turn.toRotationMatrix() * motion.X_FS.linear();
      }
      return LevelledMotion(other, StanceOf(kFirst)).motion_F;
    };
    by_error.col(i) = (disturbed(kStep) - disturbed(-kStep)) / (2.0 * kStep);
  }
  // Any symmetric positive matrix with everything correlated.
  core::RandomStream stream({.seed = 5}, core::Purpose::kTest);
  messages::PoseCovariance root;
  for (double& value : root.reshaped()) value = stream.Uniform() - 0.5;
  motion.covariance = root * root.transpose();
  const messages::PoseCovariance expected = by_error * motion.covariance * by_error.transpose();
  const messages::RelativeMotion levelled = LevelledMotion(motion, StanceOf(kFirst));
  EXPECT_LT((levelled.covariance - expected).norm(), 1e-8 * expected.norm());
}

TEST(VisualMotionTest, AWrongStanceTiltsTheWay) {
  FirstStance stance = StanceOf(kFirst);
  stance.tilt_sd_rad = 0.02;
  const messages::RelativeMotion sure =
      LevelledMotion(MotionBetween(kFirst, kSecond), StanceOf(kFirst));
  const messages::RelativeMotion unsure = LevelledMotion(MotionBetween(kFirst, kSecond), stance);
  messages::PoseCovariance added = unsure.covariance - sure.covariance;
  const int z = Index(PoseCoordinate::kZ);
  EXPECT_NEAR(added(z, z), 0.02 * 0.02 * (0.6 * 0.6 + 0.5 * 0.5), 1e-12);
  added(z, z) = 0.0;
  EXPECT_EQ(added.norm(), 0.0);
}

}  // namespace
}  // namespace rockyard::perception
