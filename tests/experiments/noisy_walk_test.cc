#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "experiments/dead_reckoning/dead_reckoning.h"

namespace rockyard::experiments {
namespace {

using localization::StepHeading;

// Wheels of unlike radii, known to the rover; slip on level sand as calibrated.
WalkingRover Walker(StepHeading step_heading = StepHeading::kStart) {
  WalkingRover rover;
  rover.wheels.radius_ratio = {1.0, 1.2, 0.9, 1.0, 1.1, 0.95};
  rover.believed = rover.wheels;
  rover.dead_reckoning.distance_scale = 0.93;
  rover.dead_reckoning.step_heading = step_heading;
  return rover;
}

WalkPlan Plan(std::int64_t steps) {
  return {.step_m = 0.067,
          .steps = steps,
          .step_s = 10.0,
          .rest_s = 20.0,
          .noise = {0.016, 0.02, 0.03},
          .scale_deviation = 0.05};
}

// The equations of section 5 as they are printed, on the same random numbers; h is not wrapped.
WalkError Plainly(const WalkPlan& plan, core::TrialKey key) {
  core::RandomStream noise(key, core::Purpose::kExperiment);
  const double scale = 1.0 + core::SampleNormal(noise, 0.0, plan.scale_deviation);
  WalkError end;
  double heading_rad = 0.0;
  for (int i = 0; i < plan.steps; ++i) {
    const double dr_m =
        plan.step_m * scale + core::SampleNormal(noise, 0.0, plan.noise.distance_deviation_m);
    end.along_m += dr_m * std::cos(heading_rad) - plan.step_m;
    end.across_m += dr_m * std::sin(heading_rad);
    end.distance_m += std::abs(dr_m) - plan.step_m;
    heading_rad += core::SampleNormal(noise, 0.0, plan.noise.turn_deviation_rad);
    if (plan.rest_s > 0.0) {
      heading_rad += core::SampleNormal(noise, 0.0, plan.noise.rest_turn_deviation_rad);
    }
  }
  end.heading_deg = heading_rad * 180.0 / M_PI;
  return end;
}

void ExpectEqual(const WalkError& walk, const WalkError& plain) {
  EXPECT_NEAR(walk.along_m, plain.along_m, 1e-11);
  EXPECT_NEAR(walk.across_m, plain.across_m, 1e-11);
  EXPECT_NEAR(walk.heading_deg, plain.heading_deg, 1e-9);
  EXPECT_NEAR(walk.distance_m, plain.distance_m, 1e-11);
}

TEST(NoisyWalkTest, IsThePrintedEquationsThroughTheDeadReckoningThatFlies) {
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    ExpectEqual(WalkStraight(Walker(), Plan(150), {7, trial}), Plainly(Plan(150), {7, trial}));
  }
  WalkPlan without_rest = Plan(150);
  without_rest.rest_s = 0.0;
  ExpectEqual(WalkStraight(Walker(), without_rest, {7, 1}), Plainly(without_rest, {7, 1}));
  EXPECT_NE(WalkStraight(Walker(), without_rest, {7, 1}).across_m,
            WalkStraight(Walker(), Plan(150), {7, 1}).across_m);
  // Negative control: half of a step's turn first is something else.
  EXPECT_GT(std::abs(WalkStraight(Walker(StepHeading::kMidpoint), Plan(150), {7, 1}).across_m -
                     Plainly(Plan(150), {7, 1}).across_m),
            1e-4);
}

TEST(NoisyWalkTest, WithoutNoiseThereIsNoError) {
  WalkPlan plan = Plan(150);
  plan.noise = {};
  plan.scale_deviation = 0.0;
  ExpectEqual(WalkStraight(Walker(), plan, {1, 0}), WalkError{});
}

// What the rover believes of its wheels counts, not what they are.
TEST(NoisyWalkTest, AWrongCalibrationShows) {
  WalkPlan plan = Plan(100);
  plan.noise = {};
  plan.scale_deviation = 0.0;
  WalkingRover rover = Walker();
  rover.believed.wheel_radius_m *= 1.02;
  const WalkError error = WalkStraight(rover, plan, {1, 0});
  EXPECT_NEAR(error.along_m, 0.02 * 6.7, 1e-12);
  EXPECT_NEAR(error.distance_m, 0.02 * 6.7, 1e-12);
  EXPECT_EQ(error.across_m, 0.0);
}

TEST(NoisyWalkTest, AScaleErrorGrowsWithTheWay) {
  WalkPlan plan = Plan(50);
  plan.noise = {};
  const WalkError near = WalkStraight(Walker(), plan, {3, 5});
  plan.steps = 200;
  const WalkError far = WalkStraight(Walker(), plan, {3, 5});
  EXPECT_GT(std::abs(near.along_m), 1e-3);
  EXPECT_NEAR(far.along_m, 4.0 * near.along_m, 1e-12);
}

TEST(WalkSumsTest, SumSquaresAndDeviationByHand) {
  const std::vector<WalkError> errors{{.along_m = 1.0}, {.along_m = 3.0}, {.along_m = 8.0}};
  const WalkErrorSums sums = SumsOf(errors, &WalkError::along_m);
  EXPECT_EQ(sums.sum, 12.0);
  EXPECT_EQ(sums.squares, 74.0);
  EXPECT_NEAR(sums.deviation, 3.0 * std::sqrt((9.0 + 1.0 + 16.0) / 2.0), 1e-12);
}

}  // namespace
}  // namespace rockyard::experiments
