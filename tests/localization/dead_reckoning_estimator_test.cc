#include <gtest/gtest.h>

#include <cmath>

#include "localization/dead_reckoning.h"
#include "math/pose.h"

namespace rockyard::localization {
namespace {

constexpr double kTick_s = 0.05;

EstimatorSetup StartSetup() { return EstimatorSetup{.start = {1.0, 2.0, 0.5}}; }

messages::MotionMeasurement Rolling(double wheel_turn_rad, double turn_rad = 0.0) {
  messages::MotionMeasurement motion{.duration_s = kTick_s};
  motion.wheel_turn_rad.fill(wheel_turn_rad);
  motion.turn_rad = turn_rad;
  return motion;
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

}  // namespace
}  // namespace rockyard::localization
