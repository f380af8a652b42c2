// How many moves the rover was told to make.
#pragma once

#include <cstdint>

#include "messages/commands.h"

namespace rockyard::trial {

// A move is one motion command, held until another one follows or the rover looks: an arc, or a
// turn in place. Where a navigator numbers its moves, its number tells one from the next instead:
// looks, and curvatures that change at each tick, belong to the move under way.
class MoveCounter {
 public:
  // Once a control tick, with what the navigator told; true where a move begins.
  bool Observe(const messages::MotionCommand& motion) {
    const bool same = motion.move != 0 ? motion.move == last_.move : moving_ && motion == last_;
    moving_ = motion.kind != messages::MotionKind::kStop;
    last_ = motion;
    if (same || !moving_) return false;
    ++moves_;
    if (motion.kind == messages::MotionKind::kTurnInPlace) {
      ++point_turns_;
    } else {
      if (motion.direction == -way_) ++reversals_;
      way_ = motion.direction;
    }
    return true;
  }
  void OnLook() { moving_ = false; }

  std::int64_t moves() const { return moves_; }
  std::int64_t point_turns() const { return point_turns_; }
  // Arcs driven the other way than the last arc before, whatever lies between them.
  std::int64_t reversals() const { return reversals_; }

 private:
  messages::MotionCommand last_;
  bool moving_ = false;
  std::int64_t moves_ = 0;
  int way_ = 0;  // of the last arc, 0 before the first
  std::int64_t point_turns_ = 0;
  std::int64_t reversals_ = 0;
};

}  // namespace rockyard::trial
