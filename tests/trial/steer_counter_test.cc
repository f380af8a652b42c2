#include "trial/steer_counter.h"

#include <gtest/gtest.h>

#include "core/check.h"

namespace rockyard::trial {
namespace {

constexpr messages::PerWheel<bool> kCorners = {true, false, true, true, false, true};
constexpr messages::PerWheel<bool> kAll = {true, true, true, true, true, true};

TEST(SteerCounterTest, ToAndFroAddUp) {
  SteerCounter counter(kCorners);
  counter.Observe({0.2, 0.0, -0.2, 0.1, 0.0, -0.1});
  counter.Observe({0.2, 0.0, -0.2, 0.1, 0.0, -0.1});
  counter.Observe({-0.1, 0.0, 0.1, 0.0, 0.0, 0.0});
  // 0.2 + 0.3 twice, 0.1 + 0.1 twice.
  EXPECT_NEAR(counter.mean_rad(), (0.5 + 0.5 + 0.2 + 0.2) / 4.0, 1e-15);
  EXPECT_NEAR(counter.max_rad(), 0.5, 1e-15);
}

TEST(SteerCounterTest, EitherSideAndWayCountAlike) {
  SteerCounter left(kCorners);
  SteerCounter right(kCorners);
  left.Observe({0.3, 0.0, -0.2, 0.2, 0.0, -0.1});
  right.Observe({-0.2, 0.0, 0.1, -0.3, 0.0, 0.2});
  EXPECT_NEAR(left.mean_rad(), right.mean_rad(), 1e-15);
  EXPECT_EQ(left.max_rad(), right.max_rad());
}

// The mean is over the motors that there are.
TEST(SteerCounterTest, WheelsThatAreNotSteeredHaveNoMotor) {
  const messages::PerWheel<double> angles = {0.1, 0.9, 0.1, 0.1, 0.0, 0.1};
  SteerCounter corners(kCorners);
  corners.Observe(angles);
  EXPECT_NEAR(corners.mean_rad(), 0.1, 1e-15);
  EXPECT_NEAR(corners.max_rad(), 0.1, 1e-15);
  SteerCounter all(kAll);
  all.Observe(angles);
  EXPECT_NEAR(all.mean_rad(), 1.3 / 6.0, 1e-15);
  EXPECT_NEAR(all.max_rad(), 0.9, 1e-15);
  EXPECT_THROW(SteerCounter(messages::PerWheel<bool>{}), core::ContractViolation);
}

TEST(SteerCounterTest, WhatIsTurnedByHandDoesNotCount) {
  SteerCounter counter(kCorners);
  counter.Observe({0.4, 0.0, 0.4, 0.4, 0.0, 0.4});
  counter.Restart({});
  counter.Observe({0.1, 0.0, 0.1, 0.1, 0.0, 0.1});
  EXPECT_NEAR(counter.mean_rad(), 0.5, 1e-15);
}

}  // namespace
}  // namespace rockyard::trial
