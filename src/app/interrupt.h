// Ctrl-C, politely.
#pragma once

#include <atomic>

namespace rockyard::app {

// What the second polite signal does.
enum class SecondSignal {
  kEnds,      // the process at once, which loses no stored trial
  kIsTheSame  // nothing more: somebody else (a supervisor, mpirun) decides when patience ends
};

// While this lives, the first SIGINT, SIGTERM, SIGHUP or SIGUSR1 sets the flag. Writing to a closed
// pipe or beyond a file size limit becomes an error instead of a signal. One at a time; the former
// handlers come back at the end.
class InterruptGuard {
 public:
  // `requested` must outlive this; it may be shared with others who may ask for an end.
  InterruptGuard(std::atomic<bool>& requested, SecondSignal second);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

}  // namespace rockyard::app
