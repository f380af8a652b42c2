// What an estimator keeps over a night, and what it begins the next day with.
#include <gtest/gtest.h>

#include "localization/dead_reckoning.h"
#include "localization/filter_rover.h"
#include "localization/visual_odometry_estimator.h"

namespace rockyard::localization {
namespace {

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
  for (const int row :
       {error::kX, error::kY, error::kHeading, error::kGyroScale, error::kWheelScale}) {
    for (const int column :
         {error::kX, error::kY, error::kHeading, error::kGyroScale, error::kWheelScale}) {
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
