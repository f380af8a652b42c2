// What an estimator keeps over a night, and what it begins the next day with.
#include <gtest/gtest.h>

#include "localization/dead_reckoning_estimator.h"
#include "localization/filter_rover.h"
#include "localization/visual_odometry_estimator.h"

namespace rockyard::localization {
namespace {

ErrorStateFilterParams Uncertain() {
  ErrorStateFilterParams params;
  params.prior.gyro_bias_sd_rad_s = 1e-4;
  params.drift.scrapes_per_m = 0.3;
  return params;
}

void DriveInACurve(Estimator& estimator, int ticks) {
  for (int i = 0; i < ticks; ++i) estimator.Propagate(Rolled(0.005, 0.002, 0.05));
}

messages::PoseFix PlaceFix(double x_m, double y_m, double sd_m) {
  messages::PoseFix fix;
  for (const int coordinate : {error::kX, error::kY}) {
    fix.measured.set(static_cast<std::size_t>(coordinate));
    fix.covariance(coordinate, coordinate) = sd_m * sd_m;
  }
  fix.pose_W[error::kX] = x_m;
  fix.pose_W[error::kY] = y_m;
  return fix;
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

TEST(EstimatorMemoryTest, TheFilterGoesOnWhereItWas) {
  EstimatorSetup setup = FilterSetup();
  ErrorStateFilter evening(Uncertain(), setup);
  DriveInACurve(evening, 400);
  evening.Capture(0);
  evening.Update(PlaceFix(2.5, -1.2, 0.1));
  evening.Forget(0);
  const EstimatorMemory memory = evening.Remember();
  EXPECT_NE(memory.gyro_scale, 1.0);
  EXPECT_NE(memory.wheel_scale, 1.0);

  setup.start = memory.pose;
  setup.memory = &memory;
  ErrorStateFilter morning(Uncertain(), setup);
  EXPECT_EQ(morning.estimate().pose.x_m, evening.estimate().pose.x_m);
  EXPECT_EQ(morning.estimate().pose.heading_rad, evening.estimate().pose.heading_rad);
  EXPECT_EQ(morning.gyro_scale(), evening.gyro_scale());
  EXPECT_EQ(morning.wheel_scale(), evening.wheel_scale());
  for (const int row :
       {error::kX, error::kY, error::kHeading, error::kGyroScale, error::kWheelScale}) {
    for (const int column :
         {error::kX, error::kY, error::kHeading, error::kGyroScale, error::kWheelScale}) {
      EXPECT_EQ(morning.covariance()(row, column), evening.covariance()(row, column));
    }
  }
}

// The gyro is switched on anew; tilt and height are of the new day.
TEST(EstimatorMemoryTest, WhatANightEndsBeginsAsAtFirst) {
  EstimatorSetup setup = FilterSetup();
  ErrorStateFilter evening(Uncertain(), setup);
  const ErrorMatrix first = evening.covariance();
  DriveInACurve(evening, 400);
  evening.Capture(0);
  evening.Update(PlaceFix(2.5, -1.2, 0.1));
  EXPECT_NE(evening.gyro_bias_rad_s(), 0.0);
  const EstimatorMemory memory = evening.Remember();
  setup.memory = &memory;
  setup.start = memory.pose;
  const ErrorStateFilter morning(Uncertain(), setup);
  EXPECT_EQ(morning.gyro_bias_rad_s(), 0.0);
  EXPECT_EQ(morning.estimate().pose.distance_m, 0.0);
  for (const int row : {error::kZ, error::kRoll, error::kPitch, error::kGyroBias}) {
    for (int column = 0; column < kErrorCoordinates; ++column) {
      EXPECT_EQ(morning.covariance()(row, column), first(row, column)) << row << ", " << column;
      EXPECT_EQ(morning.covariance()(column, row), first(column, row)) << row << ", " << column;
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
