#include "localization/visual_odometry_estimator.h"

#include <gtest/gtest.h>

#include <numbers>

namespace rockyard::localization {
namespace {

using messages::Index;
using messages::PoseCoordinate;

constexpr double kRadius_m = 0.1;
constexpr double kTick_s = 0.1;

EstimatorSetup StartSetup() {
  return EstimatorSetup{.calibration = {.wheel_radius_m = kRadius_m},
                        .start = {1.0, -2.0, 0.5 * std::numbers::pi}};
}

messages::MotionMeasurement Tick(double forward_m, double turn_rad) {
  messages::MotionMeasurement motion{.duration_s = kTick_s};
  motion.wheel_turn_rad.fill(forward_m / kRadius_m);
  motion.turn_rad = turn_rad;
  return motion;
}

messages::RelativeMotion Seen(messages::CaptureNumber from, messages::CaptureNumber to, double x_m,
                              double y_m, double turn_rad) {
  messages::RelativeMotion motion{.from = from, .to = to};
  motion.motion_F[Index(PoseCoordinate::kX)] = x_m;
  motion.motion_F[Index(PoseCoordinate::kY)] = y_m;
  motion.motion_F[Index(PoseCoordinate::kHeading)] = turn_rad;
  return motion;
}

void ExpectPose(const messages::PoseEstimate& pose, double x_m, double y_m, double heading_rad) {
  EXPECT_NEAR(pose.x_m, x_m, 1e-12);
  EXPECT_NEAR(pose.y_m, y_m, 1e-12);
  EXPECT_NEAR(pose.heading_rad, heading_rad, 1e-12);
}

class VisualOdometryEstimatorTest : public testing::Test {
 protected:
  void Drive(double forward_m) {
    for (int i = 0; i < 10; ++i) estimator_.Propagate(Tick(0.1 * forward_m, 0.0));
  }

  VisualOdometryEstimator estimator_{StartSetup()};
};

TEST_F(VisualOdometryEstimatorTest, WithoutVisionItIsDeadReckoning) {
  DeadReckoningEstimator wheels{StartSetup()};
  for (int i = 0; i < 50; ++i) {
    const auto tick = Tick(0.01, 0.03);
    estimator_.Propagate(tick);
    wheels.Propagate(tick);
  }
  const messages::PoseEstimate& expected = wheels.estimate().pose;
  ExpectPose(estimator_.estimate().pose, expected.x_m, expected.y_m, expected.heading_rad);
  EXPECT_EQ(estimator_.estimate().odometry.x_m, expected.x_m);
  EXPECT_EQ(estimator_.estimate().pose.distance_m, expected.distance_m);
}

// Wheels that slip: 1 m by the encoders, 60 cm and a turn in truth. Told 50 cm later.
TEST_F(VisualOdometryEstimatorTest, WhatIsSeenTakesThePlaceOfWhatWheelsSay) {
  estimator_.Capture(7);
  Drive(1.0);
  estimator_.Capture(8);
  Drive(0.5);
  ExpectPose(estimator_.estimate().pose, 1.0, -0.5, 0.5 * std::numbers::pi);

  EXPECT_EQ(estimator_.Update(Seen(7, 8, 0.6, 0.1, 0.5 * std::numbers::pi)), AidUse::kUsed);
  // At 8 it was at (0.9, -1.4) and looked along -x; the half metre since goes there.
  ExpectPose(estimator_.estimate().pose, 0.4, -1.4, std::numbers::pi);
  ExpectPose(estimator_.estimate().odometry, 1.0, -0.5, 0.5 * std::numbers::pi);
  EXPECT_NEAR(estimator_.estimate().pose.distance_m, 1.5, 1e-12);
}

TEST_F(VisualOdometryEstimatorTest, LaterMomentsMoveAlong) {
  estimator_.Capture(1);
  Drive(1.0);
  estimator_.Capture(2);
  Drive(1.0);
  estimator_.Capture(3);
  ASSERT_EQ(estimator_.Update(Seen(1, 2, 0.8, 0.0, 0.0)), AidUse::kUsed);
  ASSERT_EQ(estimator_.Update(Seen(2, 3, 0.9, 0.0, 0.0)), AidUse::kUsed);
  ExpectPose(estimator_.estimate().pose, 1.0, -0.3, 0.5 * std::numbers::pi);
  // A better motion over both, from the keyframe, takes the place of the two.
  ASSERT_EQ(estimator_.Update(Seen(1, 3, 1.6, 0.0, 0.0)), AidUse::kUsed);
  ExpectPose(estimator_.estimate().pose, 1.0, -0.4, 0.5 * std::numbers::pi);
  // What lies before the motion's end stays: 2 is where it was.
  ASSERT_EQ(estimator_.Update(Seen(2, 3, 0.9, 0.0, 0.0)), AidUse::kUsed);
  ExpectPose(estimator_.estimate().pose, 1.0, -0.3, 0.5 * std::numbers::pi);
}

TEST_F(VisualOdometryEstimatorTest, ForgottenMomentsAndThoseBeforeAPlaceAreUnknown) {
  estimator_.Capture(1);
  Drive(1.0);
  estimator_.Capture(2);
  estimator_.Forget(1);
  EXPECT_EQ(estimator_.Update(Seen(1, 2, 0.8, 0.0, 0.0)), AidUse::kUnknown);
  estimator_.Place({.x_m = 3.0, .y_m = 4.0, .heading_rad = 0.0});
  estimator_.Capture(3);
  EXPECT_EQ(estimator_.Update(Seen(2, 3, 0.8, 0.0, 0.0)), AidUse::kUnknown);
  ExpectPose(estimator_.estimate().pose, 3.0, 4.0, 0.0);
  Drive(0.5);
  ExpectPose(estimator_.estimate().pose, 3.5, 4.0, 0.0);
}

TEST_F(VisualOdometryEstimatorTest, HasNoInterestInFixes) {
  estimator_.Capture(1);
  EXPECT_EQ(estimator_.Update(messages::PoseFix{}), AidUse::kNoInterest);
}

}  // namespace
}  // namespace rockyard::localization
