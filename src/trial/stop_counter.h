// How often the rover came to rest.
#pragma once

#include <cstdint>

namespace rockyard::trial {

// A stop is the end of a stretch of driving or turning: for a look, to steer the wheels at rest,
// for the overhead of a move, or because the trial is over.
class StopCounter {
 public:
  // Once a control tick; `moving` while the wheels are told to drive or to turn the rover.
  void Observe(bool moving) {
    if (moving_ && !moving) ++stops_;
    moving_ = moving;
  }

  // With the one that the end of the trial makes of a rover that still moves.
  std::int64_t stops() const { return stops_ + (moving_ ? 1 : 0); }

 private:
  bool moving_ = false;
  std::int64_t stops_ = 0;
};

}  // namespace rockyard::trial
