// Counts of stops, turns on the spot, moves and turns of the steering motors.
#include <gtest/gtest.h>

#include <initializer_list>

#include "core/check.h"
#include "trial/move_counter.h"
#include "trial/steer_counter.h"
#include "trial/stop_counter.h"
#include "trial/turn_counter.h"

namespace rockyard::trial {
namespace {

using messages::MotionCommand;
using messages::MotionKind;

std::int64_t StopsOf(std::initializer_list<bool> moving) {
  StopCounter counter;
  for (const bool each : moving) counter.Observe(each);
  return counter.stops();
}

TEST(StopCounterTest, CountsEndsOfMotion) {
  EXPECT_EQ(StopsOf({}), 0);
  EXPECT_EQ(StopsOf({false, false}), 0);
  EXPECT_EQ(StopsOf({true, true, false, false, true, false}), 2);
}

TEST(StopCounterTest, TheEndStopsARoverThatMoves) { EXPECT_EQ(StopsOf({true, false, true}), 2); }

constexpr MotionCommand kLeft{MotionKind::kTurnInPlace, 0.0, 1};
constexpr MotionCommand kRight{MotionKind::kTurnInPlace, 0.0, -1};
constexpr MotionCommand kAhead{MotionKind::kArc, 0.0, 1};
constexpr MotionCommand kBack{MotionKind::kArc, 0.0, -1};

std::int64_t Turns(std::initializer_list<MotionCommand> motions) {
  TurnCounter counter;
  for (const MotionCommand& motion : motions) counter.Observe(motion);
  return counter.turns();
}

TEST(TurnCounterTest, ATurnCountsOnceHoweverLong) {
  EXPECT_EQ(Turns({}), 0);
  EXPECT_EQ(Turns({kAhead, kBack, kAhead}), 0);
  EXPECT_EQ(Turns({kLeft, kLeft, kLeft}), 1);
}

TEST(TurnCounterTest, DrivingEndsATurn) {
  EXPECT_EQ(Turns({kLeft, kAhead, kLeft, kLeft, kBack, kRight}), 3);
}

TEST(TurnCounterTest, TheOtherWayIsAnotherTurn) {
  EXPECT_EQ(Turns({kLeft, kLeft, kRight, kRight, kLeft}), 3);
}

constexpr MotionCommand kArc{MotionKind::kArc, 0.5, 1};

TEST(MoveCounterTest, AMoveIsOneCommandUntilAnotherOneOrALook) {
  constexpr MotionCommand kBackAlongIt{MotionKind::kArc, 0.5, -1};
  MoveCounter counter;
  EXPECT_EQ(counter.moves(), 0);
  counter.Observe(kArc);
  counter.Observe(kArc);
  EXPECT_EQ(counter.moves(), 1);
  counter.OnLook();
  counter.Observe(kArc);  // the same arc again
  EXPECT_EQ(counter.moves(), 2);
  counter.Observe(kBackAlongIt);  // backs off without a look
  EXPECT_EQ(counter.moves(), 3);
  counter.Observe(MotionCommand{});  // stands: no move
  EXPECT_EQ(counter.moves(), 3);
  counter.Observe(kLeft);
  counter.Observe(kLeft);
  EXPECT_EQ(counter.moves(), 4);
  EXPECT_EQ(counter.point_turns(), 1);
}

TEST(MoveCounterTest, AMoveWithANumberIsWhateverHasTheNumber) {
  MoveCounter counter;
  MotionCommand command{.kind = MotionKind::kArc, .move = 3};
  for (int tick = 0; tick < 200; ++tick) {
    command.curvature_per_m = 0.001 * tick;
    EXPECT_EQ(counter.Observe(command), tick == 0);
  }
  counter.OnLook();
  EXPECT_FALSE(counter.Observe(command));
  EXPECT_EQ(counter.moves(), 1);
  command.move = 4;
  EXPECT_TRUE(counter.Observe(command));
  // Without one, each command that differs is a move, in its end and speed too.
  command.move = 0;
  EXPECT_TRUE(counter.Observe(command));
  command.speed_share = 0.5;
  EXPECT_TRUE(counter.Observe(command));
  command.end_m = 1.0;
  EXPECT_TRUE(counter.Observe(command));
  EXPECT_FALSE(counter.Observe(command));
  EXPECT_EQ(counter.moves(), 5);
}

TEST(MoveCounterTest, SaysWhereAMoveBegins) {
  MoveCounter counter;
  EXPECT_TRUE(counter.Observe(kArc));
  EXPECT_FALSE(counter.Observe(kArc));
  counter.OnLook();
  EXPECT_TRUE(counter.Observe(kArc));
  EXPECT_FALSE(counter.Observe(MotionCommand{}));
}

TEST(MoveCounterTest, ReversalsAreArcsTheOtherWayThanTheLastOne) {
  constexpr MotionCommand kOtherBack{MotionKind::kArc, -0.2, -1};
  MoveCounter counter;
  counter.Observe(kOtherBack);  // the first has nothing before it
  counter.OnLook();
  counter.Observe(kOtherBack);
  EXPECT_EQ(counter.reversals(), 0);
  counter.Observe(kArc);
  EXPECT_EQ(counter.reversals(), 1);
  counter.Observe(kRight);  // to the right: no way of driving
  EXPECT_EQ(counter.reversals(), 1);
  counter.OnLook();
  counter.Observe(kArc);
  EXPECT_EQ(counter.reversals(), 1);
  counter.Observe(kRight);
  counter.Observe(kOtherBack);
  EXPECT_EQ(counter.reversals(), 2);
}

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
