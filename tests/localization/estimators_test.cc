// Estimators that keep no account of their error, and what every estimator keeps over a night and
// begins the next day with.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "localization/dead_reckoning.h"
#include "localization/filter_rover.h"
#include "localization/visual_odometry_estimator.h"
#include "math/pose.h"

namespace rockyard::localization {
namespace {

using messages::Index;
using messages::PoseCoordinate;

constexpr double kTick_s = 0.05;

EstimatorSetup StartSetup() { return EstimatorSetup{.start = {1.0, 2.0, 0.5}}; }

messages::MotionMeasurement Rolling(double wheel_turn_rad, double turn_rad = 0.0) {
  return Rolled(wheel_turn_rad * kWheelRadius_m, turn_rad, kTick_s);
}

// Nose down by p: the upward force points backwards, f = g (-sin p, 0, cos p).
messages::VehicleState NoseDown(double pitch_rad) {
  messages::VehicleState felt;
  felt.specific_force_R = 9.81 * math::Vector3(-std::sin(pitch_rad), 0.0, std::cos(pitch_rad));
  return felt;
}

class DeadReckoningEstimatorTest : public testing::Test {
 protected:
  // The believed height after a tick with the nose down.
  double TickDown(double wheel_turn_rad) {
    estimator_.Propagate(Rolling(wheel_turn_rad));
    estimator_.Feel(NoseDown(0.2), kTick_s);
    return estimator_.estimate().attitude.z_m;
  }

  DeadReckoningEstimator estimator_{StartSetup()};
};

TEST_F(DeadReckoningEstimatorTest, BeginsWhereItWasPutDown) {
  EXPECT_EQ(estimator_.estimate().pose.x_m, 1.0);
  EXPECT_EQ(estimator_.estimate().odometry.y_m, 2.0);
  EXPECT_EQ(estimator_.estimate().pose.heading_rad, 0.5);
  EXPECT_FALSE(estimator_.estimate().covariance.has_value());
}

TEST_F(DeadReckoningEstimatorTest, IsTheDeadReckoningOfItsSetup) {
  DeadReckoning alone({}, {}, {1.0, 2.0, 0.5});
  for (int i = 0; i < 20; ++i) {
    const messages::MotionMeasurement motion = Rolling(0.3, 0.02 * i);
    estimator_.Propagate(motion);
    alone.Integrate(motion);
  }
  EXPECT_EQ(estimator_.estimate().pose.x_m, alone.estimate().x_m);
  EXPECT_EQ(estimator_.estimate().pose.heading_rad, alone.estimate().heading_rad);
  EXPECT_EQ(estimator_.estimate().pose.distance_m, alone.estimate().distance_m);
  EXPECT_EQ(estimator_.estimate().odometry.x_m, alone.estimate().x_m);
  EXPECT_EQ(estimator_.estimate().odometry.distance_m, alone.estimate().distance_m);
}

TEST_F(DeadReckoningEstimatorTest, WithoutAccelerometersTheRoverIsLevel) {
  estimator_.Propagate(Rolling(1.0));
  estimator_.Feel({}, kTick_s);
  EXPECT_EQ(estimator_.estimate().attitude.pitch_rad, 0.0);
  EXPECT_EQ(estimator_.estimate().attitude.z_m, 0.0);
}

TEST_F(DeadReckoningEstimatorTest, AccelerometersLevelTheRover) {
  estimator_.Feel(NoseDown(0.2), kTick_s);
  EXPECT_NEAR(estimator_.estimate().attitude.pitch_rad, 0.2, 1e-12);
  EXPECT_NEAR(estimator_.estimate().attitude.roll_rad, 0.0, 1e-12);
}

TEST_F(DeadReckoningEstimatorTest, HeightGrowsByWhatWasDrivenSinceTheLastTick) {
  const double height_m = TickDown(1.0);
  EXPECT_NEAR(height_m, -0.065 * std::sin(0.2), 1e-12);
  EXPECT_NEAR(TickDown(1.0), 2.0 * height_m, 1e-12);
  EXPECT_NEAR(TickDown(1.0), 3.0 * height_m, 1e-12);
}

// What the rover felt before says nothing of how it stands now.
TEST(DeadReckoningEstimator, AttitudeBeginsAnewWhereOperatorsMovedTheRover) {
  EstimatorSetup setup = StartSetup();
  setup.attitude.filter_s = 10.0;
  DeadReckoningEstimator estimator(setup);
  estimator.Feel(NoseDown(0.2), kTick_s);
  estimator.Feel(NoseDown(0.0), kTick_s);
  EXPECT_GT(estimator.estimate().attitude.pitch_rad, 0.19);
  estimator.Place({3.0, -1.0, 0.5});
  estimator.Feel(NoseDown(0.0), kTick_s);
  EXPECT_NEAR(estimator.estimate().attitude.pitch_rad, 0.0, 1e-12);
}

// Operators set the pose; the rover has not climbed there.
TEST_F(DeadReckoningEstimatorTest, APoseUpdateLeavesTheBelievedHeight) {
  const double before_m = TickDown(1.0);
  ASSERT_LT(before_m, -0.01);
  estimator_.Place({3.0, -1.0, 0.5});
  EXPECT_EQ(estimator_.estimate().pose.x_m, 3.0);
  EXPECT_EQ(estimator_.estimate().odometry.x_m, 3.0);
  EXPECT_EQ(estimator_.estimate().attitude.z_m, before_m);
  EXPECT_NEAR(TickDown(0.0), before_m, 1e-12);
  // From here on as before: one roll more is the same step down.
  EXPECT_NEAR(TickDown(1.0), 2.0 * before_m, 1e-12);
}

TEST_F(DeadReckoningEstimatorTest, TakesNoAids) {
  estimator_.Capture(0);
  messages::PoseFix fix;
  fix.measured.set();
  EXPECT_EQ(estimator_.Update(fix), AidUse::kNoInterest);
  EXPECT_EQ(estimator_.Update(messages::RelativeMotion{}), AidUse::kNoInterest);
  EXPECT_EQ(estimator_.estimate().pose.x_m, 1.0);
}

constexpr double kRadius_m = 0.1;

EstimatorSetup VisionSetup() {
  return EstimatorSetup{.calibration = {.wheel_radius_m = kRadius_m},
                        .start = {1.0, -2.0, 0.5 * std::numbers::pi}};
}

messages::MotionMeasurement Tick(double forward_m, double turn_rad) {
  messages::MotionMeasurement motion{.duration_s = 0.1, .turn_rad = turn_rad};
  motion.wheel_turn_rad.fill(forward_m / kRadius_m);
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

  VisualOdometryEstimator estimator_{VisionSetup()};
};

TEST_F(VisualOdometryEstimatorTest, WithoutVisionItIsDeadReckoning) {
  DeadReckoningEstimator wheels{VisionSetup()};
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

// What an estimator keeps over a night, and what it begins the next day with.

ErrorStateFilterParams Uncertain() {
  return ErrorStateFilterParams{.prior = {.gyro_bias_sd_rad_s = 1e-4},
                                .drift = {.scrapes_per_m = 0.3}};
}

void DriveInACurve(Estimator& estimator, int ticks) {
  for (int i = 0; i < ticks; ++i) estimator.Propagate(Rolled(0.005, 0.002, 0.05));
}

TEST(EstimatorMemoryTest, EstimatorsWithoutAnAccountRememberTheirPose) {
  DeadReckoningEstimator wheels(FilterSetup());
  DriveInACurve(wheels, 100);
  const EstimatorMemory memory = wheels.Remember();
  EXPECT_EQ(memory.pose.x_m, wheels.estimate().pose.x_m);
  EXPECT_EQ(memory.pose.y_m, wheels.estimate().pose.y_m);
  EXPECT_EQ(memory.pose.heading_rad, wheels.estimate().pose.heading_rad);
  EXPECT_FALSE(memory.covariance.has_value());
  VisualOdometryEstimator vision(FilterSetup());
  DriveInACurve(vision, 100);
  EXPECT_EQ(vision.Remember().pose.x_m, vision.estimate().pose.x_m);
  EXPECT_EQ(vision.Remember().pose.heading_rad, vision.estimate().pose.heading_rad);
}

// A filter after a day with one fix, and what it was told at first.
class FilterMemoryTest : public testing::Test {
 protected:
  FilterMemoryTest() {
    DriveInACurve(evening_, 400);
    evening_.Capture(0);
    evening_.Update(PlaceFix(0, 2.5, -1.2, 0.1));
    evening_.Forget(0);
    memory_ = evening_.Remember();
  }

  ErrorStateFilter Morning() {
    EstimatorSetup setup = FilterSetup();
    setup.start = memory_.pose;
    setup.memory = &memory_;
    return {Uncertain(), setup};
  }

  ErrorStateFilter evening_{Uncertain(), FilterSetup()};
  const ErrorMatrix first_ = evening_.covariance();
  EstimatorMemory memory_;
};

TEST_F(FilterMemoryTest, TheFilterGoesOnWhereItWas) {
  EXPECT_NE(memory_.gyro_scale, 1.0);
  EXPECT_NE(memory_.wheel_scale, 1.0);
  const ErrorStateFilter morning = Morning();
  EXPECT_EQ(morning.estimate().pose.x_m, evening_.estimate().pose.x_m);
  EXPECT_EQ(morning.estimate().pose.heading_rad, evening_.estimate().pose.heading_rad);
  EXPECT_EQ(morning.gyro_scale(), evening_.gyro_scale());
  EXPECT_EQ(morning.wheel_scale(), evening_.wheel_scale());
  constexpr int kKept[] = {error::kX, error::kY, error::kHeading, error::kGyroScale,
                           error::kWheelScale};
  for (const int row : kKept) {
    for (const int column : kKept) {
      EXPECT_EQ(morning.covariance()(row, column), evening_.covariance()(row, column));
    }
  }
}

// What the mast's and the world's fixes told of the pan angle is the mission's.
TEST(EstimatorMemoryTest, HoldsThePanAngle) {
  EstimatorSetup setup = FilterSetup();
  setup.lander = {.x_m = -8.0, .y_m = 3.0, .pan_sd_rad = math::DegToRad(2.0)};
  ErrorStateFilter evening(Uncertain(), setup);
  DriveInACurve(evening, 300);
  evening.Capture(0);
  messages::PoseFix mast = PlaceFix(0, evening.estimate().pose.x_m + 0.1, -1.0, 0.05);
  mast.in_lander_frame = true;
  ASSERT_EQ(evening.Update(mast), AidUse::kUsed);
  EXPECT_GT(std::abs(evening.pan_rad()), 1e-4);
  const EstimatorMemory memory = evening.Remember();
  setup.start = memory.pose;
  setup.memory = &memory;
  const ErrorStateFilter morning(Uncertain(), setup);
  EXPECT_EQ(morning.pan_rad(), evening.pan_rad());
  EXPECT_NEAR(morning.estimate().pose.x_m, evening.estimate().pose.x_m, 1e-12);
  EXPECT_NEAR(morning.estimate().world->pose.x_m, evening.estimate().world->pose.x_m, 1e-12);
  EXPECT_NE(morning.estimate().pose.x_m, morning.estimate().world->pose.x_m);
  for (const int row : {error::kX, error::kHeading, error::kPan}) {
    EXPECT_EQ(morning.covariance()(row, error::kPan), evening.covariance()(row, error::kPan));
  }
}

// The gyro is switched on anew; tilt and height are of the new day.
TEST_F(FilterMemoryTest, WhatANightEndsBeginsAsAtFirst) {
  EXPECT_NE(evening_.gyro_bias_rad_s(), 0.0);
  const ErrorStateFilter morning = Morning();
  EXPECT_EQ(morning.gyro_bias_rad_s(), 0.0);
  EXPECT_EQ(morning.estimate().pose.distance_m, 0.0);
  for (const int row : {error::kZ, error::kRoll, error::kPitch, error::kGyroBias}) {
    for (int column = 0; column < kErrorCoordinates; ++column) {
      EXPECT_EQ(morning.covariance()(row, column), first_(row, column)) << row << ", " << column;
      EXPECT_EQ(morning.covariance()(column, row), first_(column, row)) << row << ", " << column;
    }
  }
}

// Between two ends of stretches as well: 0.067 m are 13.4 ticks.
TEST(EstimatorMemoryTest, HoldsTheStretchSoFar) {
  ErrorStateFilter filter(Uncertain(), FilterSetup());
  DriveInACurve(filter, 20);
  const ErrorMatrix told = filter.covariance();
  const EstimatorMemory memory = filter.Remember();
  ASSERT_TRUE(memory.covariance.has_value());
  EXPECT_GT((*memory.covariance)(error::kHeading, error::kHeading),
            told(error::kHeading, error::kHeading));
  filter.Capture(0);  // ends the stretch
  EXPECT_LT((*memory.covariance - filter.covariance()).norm(), 1e-15);
}

}  // namespace
}  // namespace rockyard::localization
