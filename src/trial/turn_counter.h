// How often the rover was told to turn in place.
#pragma once

#include <cstdint>

#include "messages/commands.h"

namespace rockyard::trial {

class TurnCounter {
 public:
  // Once a control tick, with what the navigator told. Scans are not shown: a turn goes on across
  // them. The other way round is another turn.
  void Observe(const messages::MotionCommand& motion) {
    const bool turning = motion.kind == messages::MotionKind::kTurnInPlace;
    const int direction = turning ? motion.direction : 0;
    if (turning && direction != direction_) ++turns_;
    direction_ = direction;
  }

  std::int64_t turns() const { return turns_; }

 private:
  int direction_ = 0;  // of the turn under way, 0 without one
  std::int64_t turns_ = 0;
};

}  // namespace rockyard::trial
