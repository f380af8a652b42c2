// Ctrl-C, politely.
#pragma once

#include <atomic>

namespace rockyard::app {

// While this lives, the first SIGINT, SIGTERM or SIGHUP sets a flag, and the second one ends the
// process at once (which loses no stored trial). Writing to a closed pipe or beyond a file size
// limit becomes an error instead of a signal. One at a time; the former handlers come back at the
// end.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  const std::atomic<bool>& requested() const;
};

}  // namespace rockyard::app
