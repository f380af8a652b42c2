#include "trial/move_counter.h"

#include <gtest/gtest.h>

namespace rockyard::trial {
namespace {

using messages::MotionCommand;
using messages::MotionKind;

TEST(MoveCounterTest, AMoveIsOneCommandUntilAnotherOneOrALook) {
  constexpr MotionCommand kArc{MotionKind::kArc, 0.5, 1};
  constexpr MotionCommand kBack{MotionKind::kArc, 0.5, -1};
  constexpr MotionCommand kTurn{MotionKind::kTurnInPlace, 0.0, 1};
  MoveCounter counter;
  EXPECT_EQ(counter.moves(), 0);
  counter.Observe(kArc);
  counter.Observe(kArc);
  EXPECT_EQ(counter.moves(), 1);
  counter.OnLook();
  counter.Observe(kArc);  // the same arc again
  EXPECT_EQ(counter.moves(), 2);
  counter.Observe(kBack);  // backs off without a look
  EXPECT_EQ(counter.moves(), 3);
  counter.Observe(MotionCommand{});  // stands: no move
  EXPECT_EQ(counter.moves(), 3);
  counter.Observe(kTurn);
  counter.Observe(kTurn);
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
  constexpr MotionCommand kArc{MotionKind::kArc, 0.5, 1};
  MoveCounter counter;
  EXPECT_TRUE(counter.Observe(kArc));
  EXPECT_FALSE(counter.Observe(kArc));
  counter.OnLook();
  EXPECT_TRUE(counter.Observe(kArc));
  EXPECT_FALSE(counter.Observe(MotionCommand{}));
}

TEST(MoveCounterTest, ReversalsAreArcsTheOtherWayThanTheLastOne) {
  constexpr MotionCommand kAhead{MotionKind::kArc, 0.5, 1};
  constexpr MotionCommand kBack{MotionKind::kArc, -0.2, -1};
  constexpr MotionCommand kTurn{MotionKind::kTurnInPlace, 0.0, -1};
  MoveCounter counter;
  counter.Observe(kBack);  // the first has nothing before it
  counter.OnLook();
  counter.Observe(kBack);
  EXPECT_EQ(counter.reversals(), 0);
  counter.Observe(kAhead);
  EXPECT_EQ(counter.reversals(), 1);
  counter.Observe(kTurn);  // to the right: no way of driving
  EXPECT_EQ(counter.reversals(), 1);
  counter.OnLook();
  counter.Observe(kAhead);
  EXPECT_EQ(counter.reversals(), 1);
  counter.Observe(kTurn);
  counter.Observe(kBack);
  EXPECT_EQ(counter.reversals(), 2);
}

}  // namespace
}  // namespace rockyard::trial
