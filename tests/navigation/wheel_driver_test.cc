// The rover stands to steer far and steers a little while it drives.
#include "navigation/wheel_driver.h"

#include <gtest/gtest.h>

#include <limits>

#include "pathfinder/drive_geometry.h"

namespace rockyard::navigation {
namespace {

constexpr double kTick_s = 0.02;

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
  const double back_ticks = 0.1 / kTick_s;
  EXPECT_LE(StandingTicks(driver, Arc(0.0)), back_ticks + 1.0);
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
  WheelDriverParams at_once;
  at_once.steer_rate_rad_s = 1e3;
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
  WheelDriverParams fast;
  fast.steer_rate_rad_s = 4.0 * WheelDriverParams{}.steer_rate_rad_s;
  WheelDriver slow_driver(SixWheels(), {});
  WheelDriver fast_driver(SixWheels(), fast);
  EXPECT_GT(StandingTicks(slow_driver, TurnInPlace(1)),
            2 * StandingTicks(fast_driver, TurnInPlace(1)));
}

}  // namespace
}  // namespace rockyard::navigation
