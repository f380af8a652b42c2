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
using messages::RelativeMotion;

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
  vision::Motion motion{.X_FS = first.X_W().inverse() * second.X_W()};
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
  const RelativeMotion levelled = LevelledMotion(MotionBetween(kFirst, kSecond), StanceOf(kFirst));
  EXPECT_LT((levelled.motion_F - Expected(kFirst, kSecond)).norm(), 1e-12);
}

TEST(VisualMotionTest, StandingStillIsNoMotion) {
  EXPECT_LT(LevelledMotion(MotionBetween(kFirst, kFirst), StanceOf(kFirst)).motion_F.norm(), 1e-12);
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
  const RelativeMotion levelled = LevelledMotion(motion, StanceOf(kFirst));
  EXPECT_LT((levelled.covariance - expected).norm(), 1e-8 * expected.norm());
}

TEST(VisualMotionTest, AWrongStanceTiltsTheWay) {
  FirstStance stance = StanceOf(kFirst);
  stance.tilt_sd_rad = 0.02;
  const RelativeMotion sure = LevelledMotion(MotionBetween(kFirst, kSecond), StanceOf(kFirst));
  const RelativeMotion unsure = LevelledMotion(MotionBetween(kFirst, kSecond), stance);
  messages::PoseCovariance added = unsure.covariance - sure.covariance;
  const int z = Index(PoseCoordinate::kZ);
  EXPECT_NEAR(added(z, z), 0.02 * 0.02 * (0.6 * 0.6 + 0.5 * 0.5), 1e-12);
  added(z, z) = 0.0;
  EXPECT_EQ(added.norm(), 0.0);
}

RelativeMotion Seen(double x_m, double y_m, double sd_x_m, double sd_y_m) {
  RelativeMotion motion;
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
  EXPECT_NEAR(SlipOf({-0.5, 0.0}, Seen(-0.4, 0.0, 0.0, 0.0), kParams)->slip, 0.2, 1e-12);
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
