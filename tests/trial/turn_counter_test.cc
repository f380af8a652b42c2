#include "trial/turn_counter.h"

#include <gtest/gtest.h>

namespace rockyard::trial {
namespace {

using messages::MotionCommand;
using messages::MotionKind;

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

}  // namespace
}  // namespace rockyard::trial
