// Motors that come to speed.
#include "rover/motor_ramp.h"

#include <gtest/gtest.h>

namespace rockyard::rover {
namespace {

using messages::kWheelCount;
using messages::PerWheel;

// Top speed 15 cm/s on wheels of 65 mm.
constexpr double kTop_rad_s = 0.15 / 0.065;

RoverParams WithRamp(double ramp_s) { return RoverParams{.drive = {.ramp_s = ramp_s}}; }

PerWheel<double> All(double rate_rad_s) {
  PerWheel<double> rates;
  rates.fill(rate_rad_s);
  return rates;
}

TEST(MotorRamp, RisesAtConstantAccelerationAndEndsAtTheCommand) {
  MotorRamp ramp(WithRamp(0.1));
  for (int step = 0; step < 4; ++step) {
    const MotorRates rates = ramp.Advance(All(kTop_rad_s), 0.025);
    EXPECT_NEAR(rates.from[2], kTop_rad_s * step / 4.0, 1e-12);
    EXPECT_NEAR(rates.to[2], kTop_rad_s * (step + 1) / 4.0, 1e-12);
  }
  const MotorRates steady = ramp.Advance(All(kTop_rad_s), 0.025);
  EXPECT_EQ(steady.from, All(kTop_rad_s));
  EXPECT_EQ(steady.to, All(kTop_rad_s));
}

TEST(MotorRamp, FallsAsItRises) {
  MotorRamp ramp(WithRamp(0.1));
  ramp.Advance(All(-kTop_rad_s), 1.0);
  const MotorRates rates = ramp.Advance(All(0.0), 0.05);
  EXPECT_NEAR(rates.from[0], -kTop_rad_s, 1e-12);
  EXPECT_NEAR(rates.to[0], -0.5 * kTop_rad_s, 1e-12);
}

// From one way round to the other takes two ramps.
TEST(MotorRamp, ReversesThroughRest) {
  MotorRamp ramp(WithRamp(0.1));
  ramp.Advance(All(kTop_rad_s), 1.0);
  EXPECT_NEAR(ramp.Advance(All(-kTop_rad_s), 0.1).to[0], 0.0, 1e-12);
  EXPECT_NEAR(ramp.Advance(All(-kTop_rad_s), 0.1).to[0], -kTop_rad_s, 1e-12);
}

TEST(MotorRamp, JumpsWithoutARamp) {
  MotorRamp ramp(WithRamp(0.0));
  const MotorRates rates = ramp.Advance(All(kTop_rad_s), 1e-3);
  EXPECT_EQ(rates.from, All(kTop_rad_s));
  EXPECT_EQ(rates.to, All(kTop_rad_s));
}

// Where the ramp ends within the step, the straight line from `from` to `to` has the mean rate of
// ramp and rest: half of the step ramping, half at the top, is 3/4 of it.
TEST(MotorRamp, KeepsTheMeanRateOfTheStepInWhichItEnds) {
  MotorRamp ramp(WithRamp(0.1));
  const MotorRates rates = ramp.Advance(All(kTop_rad_s), 0.2);
  EXPECT_NEAR(0.5 * (rates.from[1] + rates.to[1]), 0.75 * kTop_rad_s, 1e-12);
  EXPECT_EQ(rates.to[1], kTop_rad_s);
}

// Wheels on an arc keep the ratio of their rates from the first step on, so that the rover turns
// about the same centre; all arrive together.
TEST(MotorRamp, KeepsTheRatioOfTheWheels) {
  MotorRamp ramp(WithRamp(0.1));
  PerWheel<double> arc = All(kTop_rad_s);
  for (std::size_t i = 0; i < kWheelCount; ++i) arc[i] *= 1.0 - 0.15 * static_cast<double>(i);
  for (int step = 0; step < 3; ++step) {
    const MotorRates rates = ramp.Advance(arc, 0.03);
    for (std::size_t i = 1; i < kWheelCount; ++i) {
      EXPECT_NEAR(rates.to[i] / rates.to[0], arc[i] / arc[0], 1e-12);
      EXPECT_LT(rates.to[i], arc[i]);
    }
  }
  EXPECT_EQ(ramp.Advance(arc, 0.03).to, arc);
}

TEST(MotorRamp, StandsAfterAReset) {
  MotorRamp ramp(WithRamp(0.1));
  ramp.Advance(All(kTop_rad_s), 1.0);
  ramp.Reset();
  EXPECT_EQ(ramp.Advance(All(kTop_rad_s), 0.05).from[0], 0.0);
}

}  // namespace
}  // namespace rockyard::rover
