// Ctrl-C, politely.
#pragma once

#include <atomic>

#include "campaign/stop.h"

namespace rockyard::app {

// While this lives, the first SIGINT, SIGTERM, SIGHUP or SIGUSR1 sets the flag. One at
// a time; at the end the default action of these signals comes back, except where the caller
// ignored them.
class InterruptGuard {
 public:
  // `requested` must outlive this; it may be shared with others who may ask for an end.
  InterruptGuard(std::atomic<bool>& requested, campaign::SecondWish second);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

}  // namespace rockyard::app
