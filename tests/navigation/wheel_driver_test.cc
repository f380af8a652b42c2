// The rover stands to steer far and steers a little while it drives; and steering geometry: every
// wheel rolls about the common centre of rotation.
#include "navigation/wheel_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rockyard::navigation {
namespace {

using messages::kWheelCount;

constexpr double kTick_s = 0.02;

// A six-wheel rover with steered corners.
messages::DriveCalibration SixWheels() {
  return {.wheel_radius_m = 0.065,
          .wheel_x_m = {0.22, 0.0, -0.20, 0.22, 0.0, -0.20},
          .wheel_y_m = {0.19, 0.19, 0.19, -0.19, -0.19, -0.19},
          .steered = {true, false, true, true, false, true},
          .max_steer_rad = 1.5,
          .max_wheel_speed_m_s = 0.15};
}

messages::MotionCommand Arc(double curvature_per_m, int direction = 1) {
  return {messages::MotionKind::kArc, curvature_per_m, direction};
}

messages::MotionCommand TurnInPlace(int direction) {
  return {messages::MotionKind::kTurnInPlace, 0.0, direction};
}

double FastestRim(const messages::WheelCommand& command,
                  const messages::DriveCalibration& calibration) {
  double fastest_m_s = 0.0;
  for (const double rate_rad_s : command.rate_rad_s) {
    fastest_m_s = std::max(fastest_m_s, std::abs(rate_rad_s) * calibration.wheel_radius_m);
  }
  return fastest_m_s;
}

// Largest steering angle of a motion: how far the wheels have to steer from straight.
double SteerFromStraight(const messages::MotionCommand& motion) {
  double largest_rad = 0.0;
  for (const double steer_rad : SteadyWheelCommand(motion, SixWheels()).steer_rad) {
    largest_rad = std::max(largest_rad, std::abs(steer_rad));
  }
  return largest_rad;
}

bool Stands(const messages::WheelCommand& command) {
  return FastestRim(command, SixWheels()) == 0.0;
}

void ExpectEqual(const messages::WheelCommand& a, const messages::WheelCommand& b) {
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    EXPECT_EQ(a.rate_rad_s[i], b.rate_rad_s[i]);
    EXPECT_EQ(a.steer_rad[i], b.steer_rad[i]);
  }
}

// Ticks during which the driver stands before it drives the motion.
int StandingTicks(WheelDriver& driver, const messages::MotionCommand& motion) {
  for (int ticks = 0; ticks < 10000; ++ticks) {
    if (!Stands(driver.Tick(motion, kTick_s))) return ticks;
  }
  ADD_FAILURE() << "never drives";
  return 0;
}

TEST(WheelDriver, StandsForABigChangeUntilTheWheelsAreThere) {
  const WheelDriverParams params;
  for (const messages::MotionCommand& motion :
       {TurnInPlace(1), TurnInPlace(-1), Arc(1.5), Arc(-1.5)}) {
    const double change_rad = SteerFromStraight(motion);
    ASSERT_GT(change_rad, params.steer_while_driving_rad);
    WheelDriver driver(SixWheels(), params);
    const int ticks = StandingTicks(driver, motion);
    EXPECT_FALSE(driver.steering());
    const double needed_ticks = change_rad / params.steer_rate_rad_s / kTick_s;
    EXPECT_GE(ticks, needed_ticks - 1.0);
    EXPECT_LE(ticks, needed_ticks + 2.0);
    ExpectEqual(driver.Tick(motion, kTick_s), SteadyWheelCommand(motion, SixWheels()));
  }
}

// 0.5 rad at 1 rad/s: 25 ticks of 0.02 s; and less than a tick for a little.
TEST(WheelDriver, TellsForHowLongItSteered) {
  const WheelDriverParams params{.steer_rate_rad_s = 1.0};
  WheelDriver driver(SixWheels(), params);
  const double change_rad = SteerFromStraight(Arc(1.5));
  double steered_s = 0.0;
  for (int tick = 0; tick < 200; ++tick) {
    driver.Tick(Arc(1.5), kTick_s);
    EXPECT_LE(driver.steered_s(), kTick_s);
    steered_s += driver.steered_s();
  }
  EXPECT_NEAR(steered_s, change_rad, 1e-9);
  EXPECT_EQ(driver.steered_s(), 0.0);
  driver.Tick({}, kTick_s);
  EXPECT_EQ(driver.steered_s(), 0.0);
}

TEST(WheelDriver, SteersWhileItStands) {
  WheelDriver driver(SixWheels(), {});
  const messages::WheelCommand command = driver.Tick(TurnInPlace(1), kTick_s);
  EXPECT_TRUE(driver.steering());
  EXPECT_TRUE(Stands(command));
  const messages::WheelCommand steady = SteadyWheelCommand(TurnInPlace(1), SixWheels());
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    EXPECT_EQ(command.steer_rad[i], steady.steer_rad[i]);
  }
}

TEST(WheelDriver, NeverStandsForASmallChange) {
  const WheelDriverParams params;
  for (const double curvature_per_m : {0.0, 0.1, -0.1, 0.6, -0.6}) {
    const messages::MotionCommand motion = Arc(curvature_per_m);
    ASSERT_LT(SteerFromStraight(motion), params.steer_while_driving_rad);
    WheelDriver driver(SixWheels(), params);
    for (int i = 0; i < 50; ++i) {
      ExpectEqual(driver.Tick(motion, kTick_s), SteadyWheelCommand(motion, SixWheels()));
      EXPECT_FALSE(driver.steering());
    }
  }
}

TEST(WheelDriver, SmallChangesAddUpToABigOneWithoutStanding) {
  WheelDriver driver(SixWheels(), {});
  for (double curvature_per_m = 0.0; curvature_per_m < 2.0; curvature_per_m += 0.02) {
    for (int i = 0; i < 10; ++i) {
      EXPECT_FALSE(Stands(driver.Tick(Arc(curvature_per_m), kTick_s))) << curvature_per_m;
    }
  }
  ASSERT_GT(SteerFromStraight(Arc(2.0)), 2.0 * WheelDriverParams{}.steer_while_driving_rad);
}

TEST(WheelDriver, StandsOnTheWayBackToo) {
  WheelDriver driver(SixWheels(), {});
  const int there = StandingTicks(driver, TurnInPlace(1));
  const int back = StandingTicks(driver, Arc(0.0));
  EXPECT_NEAR(there, back, 1);
  EXPECT_GT(back, 0);
}

TEST(WheelDriver, ReversingATurnInPlaceNeedsNoSteering) {
  WheelDriver driver(SixWheels(), {});
  StandingTicks(driver, TurnInPlace(1));
  EXPECT_EQ(StandingTicks(driver, TurnInPlace(-1)), 0);
}

TEST(WheelDriver, NewMotionWhileStandingCountsFromWhereTheWheelsAre) {
  const WheelDriverParams params;
  WheelDriver driver(SixWheels(), params);
  // 0.1 s at 60 deg/s: 6 deg from straight, less than is steered while driving.
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(Stands(driver.Tick(TurnInPlace(1), kTick_s)));
  EXPECT_LE(StandingTicks(driver, Arc(0.0)), (0.1 / kTick_s) + 1.0);
}

TEST(WheelDriver, StopRollsNoWheel) {
  WheelDriver driver(SixWheels(), {});
  StandingTicks(driver, TurnInPlace(1));
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(Stands(driver.Tick({}, kTick_s)));
}

// Steered while it rolls: however far from arc to arc, but not between arcs and turns in place.
TEST(WheelDriver, ThatSteersWhileRollingStandsBetweenArcsAndTurnsOnly) {
  WheelDriver driver(SixWheels(), {}, true);
  EXPECT_EQ(StandingTicks(driver, Arc(1.5)), 0);
  EXPECT_EQ(StandingTicks(driver, Arc(-1.5)), 0);
  EXPECT_GT(StandingTicks(driver, TurnInPlace(1)), 0);
  EXPECT_EQ(StandingTicks(driver, TurnInPlace(-1)), 0);
  EXPECT_GT(StandingTicks(driver, Arc(0.0)), 0);
}

// A stop while the wheels are on their way to another kind of motion: they point to neither.
TEST(WheelDriver, ThatSteersWhileRollingStandsForWheelsOnTheirWay) {
  const WheelDriverParams params;
  const double half_s = 0.5 * SteerFromStraight(TurnInPlace(1)) / params.steer_rate_rad_s;
  for (const messages::MotionCommand& next : {Arc(0.0), TurnInPlace(1)}) {
    WheelDriver driver(SixWheels(), params, true);
    StandingTicks(driver, Arc(0.0));
    EXPECT_TRUE(Stands(driver.Tick(TurnInPlace(1), half_s)));
    driver.Tick({}, kTick_s);
    EXPECT_GT(StandingTicks(driver, next), 0);
  }
}

// Every scan interrupts the motion: it must not cost steering to the middle and back.
TEST(WheelDriver, MotionResumedAfterAStopNeedsNoSteering) {
  for (const messages::MotionCommand& motion : {TurnInPlace(1), Arc(1.5)}) {
    WheelDriver driver(SixWheels(), {});
    StandingTicks(driver, motion);
    for (int i = 0; i < 100; ++i) driver.Tick({}, kTick_s);
    EXPECT_EQ(StandingTicks(driver, motion), 0);
  }
}

TEST(WheelDriver, FollowsTheSpeedOfAMotion) {
  WheelDriver driver(SixWheels(), {});
  messages::MotionCommand motion = Arc(0.0);
  for (const double share : {1.0, 0.5, 0.8}) {
    motion.speed_share = share;
    ExpectEqual(driver.Tick(motion, kTick_s), SteadyWheelCommand(motion, SixWheels()));
  }
}

// Commands of the last motion are kept: none may outlive it.
TEST(WheelDriver, EveryMotionGetsItsOwnCommand) {
  WheelDriverParams at_once{.steer_rate_rad_s = 1e3};
  WheelDriver driver(SixWheels(), at_once);
  messages::MotionCommand backward = Arc(1.5);
  backward.direction = -1;
  for (const messages::MotionCommand& motion :
       {Arc(1.5), backward, Arc(1.5), Arc(-1.5), TurnInPlace(1), TurnInPlace(-1), Arc(0.0)}) {
    StandingTicks(driver, motion);
    ExpectEqual(driver.Tick(motion, kTick_s), SteadyWheelCommand(motion, SixWheels()));
    EXPECT_TRUE(Stands(driver.Tick({}, kTick_s)));
  }
}

// Along a clothoid each tick brings other set points; all other motions may go on for ever.
TEST(WheelDriver, SaysForHowLongSetPointsAreHeld) {
  WheelDriver driver(SixWheels(), {});
  messages::MotionCommand clothoid = Arc(0.1);
  EXPECT_EQ(driver.Tick(clothoid, kTick_s).held_s, std::numeric_limits<double>::infinity());
  for (const double rate_per_m2 : {0.5, -0.5}) {
    clothoid.curvature_rate_per_m2 = rate_per_m2;
    EXPECT_EQ(driver.Tick(clothoid, kTick_s).held_s, kTick_s);
  }
  clothoid.curvature_rate_per_m2 = 0.0;
  EXPECT_EQ(driver.Tick(clothoid, kTick_s).held_s, std::numeric_limits<double>::infinity());
  EXPECT_EQ(driver.Tick({}, kTick_s).held_s, std::numeric_limits<double>::infinity());
}

TEST(WheelDriver, FasterSteeringMotorsStandShorter) {
  WheelDriverParams fast{.steer_rate_rad_s = 4.0 * WheelDriverParams{}.steer_rate_rad_s};
  WheelDriver slow_driver(SixWheels(), {});
  WheelDriver fast_driver(SixWheels(), fast);
  EXPECT_GT(StandingTicks(slow_driver, TurnInPlace(1)),
            2 * StandingTicks(fast_driver, TurnInPlace(1)));
}

constexpr double kRounding = 1e-12;

// Curvatures of both signs, down to a centre of rotation between the wheels.
constexpr double kCurvatures_per_m[] = {-8.0, -1.5, -0.6, -0.01, 0.01, 0.6, 1.5, 8.0};

TEST(SteadyWheelCommand, StopTurnsNoWheel) {
  const messages::WheelCommand command = SteadyWheelCommand({}, SixWheels());
  for (const double rate_rad_s : command.rate_rad_s) EXPECT_EQ(rate_rad_s, 0.0);
}

TEST(SteadyWheelCommand, StraightRollsAllWheelsAlikeAtFullSpeed) {
  for (const int direction : {1, -1}) {
    const messages::WheelCommand command = SteadyWheelCommand(Arc(0.0, direction), SixWheels());
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      EXPECT_NEAR(command.rate_rad_s[i], direction * 0.15 / 0.065, kRounding);
      EXPECT_EQ(command.steer_rad[i], 0.0);
    }
  }
}

TEST(SteadyWheelCommand, AxesOfSteeredWheelsPassThroughTheCentreOfRotation) {
  const messages::DriveCalibration c = SixWheels();
  for (const double curvature_per_m : kCurvatures_per_m) {
    const messages::WheelCommand command = SteadyWheelCommand(Arc(curvature_per_m), c);
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      SCOPED_TRACE(testing::Message() << "curvature " << curvature_per_m << ", wheel " << i);
      if (!c.steered[i]) {
        EXPECT_EQ(command.steer_rad[i], 0.0);
        continue;
      }
      // The wheel's rolling direction is normal to the line from the wheel to (0, 1/curvature).
      const double along =
          -c.wheel_x_m[i] * std::cos(command.steer_rad[i]) +
          (1.0 / curvature_per_m - c.wheel_y_m[i]) * std::sin(command.steer_rad[i]);
      EXPECT_NEAR(along * curvature_per_m, 0.0, kRounding);
      EXPECT_LE(std::abs(command.steer_rad[i]), c.max_steer_rad);
    }
  }
}

TEST(SteadyWheelCommand, FrontWheelsSteerIntoTheArcAndRearWheelsOutOfIt) {
  const messages::WheelCommand left = SteadyWheelCommand(Arc(0.8), SixWheels());
  const messages::WheelCommand right = SteadyWheelCommand(Arc(-0.8), SixWheels());
  for (const messages::Wheel wheel : {messages::Wheel::kLeftFront, messages::Wheel::kRightFront}) {
    EXPECT_GT(left.steer_rad[messages::Index(wheel)], 0.0);
    EXPECT_LT(right.steer_rad[messages::Index(wheel)], 0.0);
  }
  for (const messages::Wheel wheel : {messages::Wheel::kLeftRear, messages::Wheel::kRightRear}) {
    EXPECT_LT(left.steer_rad[messages::Index(wheel)], 0.0);
    EXPECT_GT(right.steer_rad[messages::Index(wheel)], 0.0);
  }
}

TEST(SteadyWheelCommand, RatesAreProportionalToTheRadiusAboutTheCentre) {
  const messages::DriveCalibration c = SixWheels();
  for (const double curvature_per_m : {-1.5, -0.6, 0.6, 1.5}) {
    const messages::WheelCommand command = SteadyWheelCommand(Arc(curvature_per_m), c);
    const double centre_y_m = 1.0 / curvature_per_m;
    const double turn_rate_rad_s =
        command.rate_rad_s[messages::Index(messages::Wheel::kLeftMiddle)] * c.wheel_radius_m /
        std::abs(centre_y_m - 0.19);
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const double radius_m = std::hypot(c.wheel_x_m[i], centre_y_m - c.wheel_y_m[i]);
      EXPECT_NEAR(command.rate_rad_s[i] * c.wheel_radius_m, turn_rate_rad_s * radius_m, kRounding);
    }
    EXPECT_NEAR(FastestRim(command, c), c.max_wheel_speed_m_s, kRounding);
  }
}

TEST(SteadyWheelCommand, WheelsInsideATightArcRollBackward) {
  // The centre of rotation lies at y = 0.125 m, between the middle and the left wheels.
  const messages::WheelCommand command = SteadyWheelCommand(Arc(8.0), SixWheels());
  EXPECT_LT(command.rate_rad_s[messages::Index(messages::Wheel::kLeftMiddle)], 0.0);
  EXPECT_GT(command.rate_rad_s[messages::Index(messages::Wheel::kRightMiddle)], 0.0);
  EXPECT_NEAR(FastestRim(command, SixWheels()), 0.15, kRounding);
}

TEST(SteadyWheelCommand, UnsteeredWheelTakesTheForwardComponent) {
  messages::DriveCalibration c = SixWheels();
  c.wheel_x_m[messages::Index(messages::Wheel::kRightMiddle)] = 0.05;
  const double curvature_per_m = 0.8;
  const messages::WheelCommand command = SteadyWheelCommand(Arc(curvature_per_m), c);
  const double ratio = command.rate_rad_s[messages::Index(messages::Wheel::kRightMiddle)] /
                       command.rate_rad_s[messages::Index(messages::Wheel::kLeftMiddle)];
  EXPECT_NEAR(ratio, (1.0 + 0.19 * curvature_per_m) / (1.0 - 0.19 * curvature_per_m), kRounding);
}

TEST(SteadyWheelCommand, BackwardKeepsTheSteeringAndReversesTheWheels) {
  for (const double curvature_per_m : kCurvatures_per_m) {
    const messages::WheelCommand forward = SteadyWheelCommand(Arc(curvature_per_m), SixWheels());
    const messages::WheelCommand backward =
        SteadyWheelCommand(Arc(curvature_per_m, -1), SixWheels());
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      EXPECT_NEAR(backward.steer_rad[i], forward.steer_rad[i], kRounding);
      EXPECT_NEAR(backward.rate_rad_s[i], -forward.rate_rad_s[i], kRounding);
    }
  }
}

TEST(SteadyWheelCommand, MirroredArcsMirrorTheWheels) {
  for (const double curvature_per_m : {0.01, 0.6, 1.5, 8.0}) {
    const messages::WheelCommand left = SteadyWheelCommand(Arc(curvature_per_m), SixWheels());
    const messages::WheelCommand right = SteadyWheelCommand(Arc(-curvature_per_m), SixWheels());
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const std::size_t other = (i + kWheelCount / 2) % kWheelCount;
      EXPECT_NEAR(left.steer_rad[i], -right.steer_rad[other], kRounding);
      EXPECT_NEAR(left.rate_rad_s[i], right.rate_rad_s[other], kRounding);
    }
  }
}

TEST(SteadyWheelCommand, TurnInPlaceRollsEveryWheelAboutTheOrigin) {
  const messages::DriveCalibration c = SixWheels();
  for (const int direction : {1, -1}) {
    const messages::WheelCommand command = SteadyWheelCommand(TurnInPlace(direction), c);
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      SCOPED_TRACE(i);
      EXPECT_LE(std::abs(command.steer_rad[i]), c.max_steer_rad);
      // Rolling velocity against that of the contact point, for the turn rate of a middle wheel.
      const double turn_rate_rad_s =
          command.rate_rad_s[messages::Index(messages::Wheel::kRightMiddle)] * c.wheel_radius_m /
          0.19;
      const double rim_m_s = command.rate_rad_s[i] * c.wheel_radius_m;
      EXPECT_NEAR(rim_m_s * std::cos(command.steer_rad[i]), -turn_rate_rad_s * c.wheel_y_m[i],
                  kRounding);
      EXPECT_NEAR(rim_m_s * std::sin(command.steer_rad[i]), turn_rate_rad_s * c.wheel_x_m[i],
                  kRounding);
      EXPECT_EQ(turn_rate_rad_s > 0.0, direction > 0);
    }
    EXPECT_NEAR(FastestRim(command, c), c.max_wheel_speed_m_s, kRounding);
  }
}

TEST(SteadyWheelCommand, TurnInPlaceIsMirrorSymmetric) {
  const messages::WheelCommand left = SteadyWheelCommand(TurnInPlace(1), SixWheels());
  const messages::WheelCommand right = SteadyWheelCommand(TurnInPlace(-1), SixWheels());
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const std::size_t other = (i + kWheelCount / 2) % kWheelCount;
    EXPECT_NEAR(left.steer_rad[i], right.steer_rad[i], kRounding);
    EXPECT_NEAR(left.rate_rad_s[i], -right.rate_rad_s[i], kRounding);
    EXPECT_NEAR(left.steer_rad[i], -left.steer_rad[other], kRounding);
    EXPECT_NEAR(left.rate_rad_s[i], -left.rate_rad_s[other], kRounding);
  }
}

TEST(SteadyWheelCommand, SteeringIsClamped) {
  messages::DriveCalibration c = SixWheels();
  c.max_steer_rad = 0.3;
  for (const messages::MotionCommand& motion :
       {TurnInPlace(1), TurnInPlace(-1), Arc(5.0), Arc(-5.0), Arc(1.0 / 0.19)}) {
    const messages::WheelCommand command = SteadyWheelCommand(motion, c);
    double largest_rad = 0.0;
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      EXPECT_TRUE(std::isfinite(command.rate_rad_s[i]));
      largest_rad = std::max(largest_rad, std::abs(command.steer_rad[i]));
    }
    EXPECT_NEAR(largest_rad, 0.3, kRounding);
    EXPECT_NEAR(FastestRim(command, c), c.max_wheel_speed_m_s, kRounding);
  }
}

}  // namespace
}  // namespace rockyard::navigation
