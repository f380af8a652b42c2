// Ends a process in which a trial hangs.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "batch/flight_log.h"

namespace rockyard::batch {

// A worker ends with this code when a trial has used up its CPU time.
inline constexpr int kOverdueExit = 75;

// What the store says of such a trial: kind and reason of an infrastructure fault.
inline constexpr const char* kOverdueKind = "cpu_time_limit";
inline constexpr const char* kOverdueReason = "the trial used more CPU time than --trial-cpu-limit";

std::vector<TrialId> TrialsOf(const std::vector<Flight>& flights);

struct WatchdogOptions {
  double cpu_limit_s = 600.0;  // of one trial; 0: none, and no thread is started
  std::chrono::milliseconds look_every{500};
  // From the end of the last trial that is not overdue to the end of the process: the time that the
  // writer of the store needs to store it.
  std::chrono::milliseconds grace{1500};
};

// A thread that reads the CPU clock of every thread with a trial. As soon as one trial has used
// more than the limit, no further trial begins; those that are not overdue end and are stored; then
// `give_up` is called with the overdue ones, which is expected to end the process (a thread cannot
// be stopped from outside). CPU time, not wall time: a busy or suspended machine kills nobody.
// No result depends on it: an overdue trial leaves no record.
class Watchdog {
 public:
  using GiveUp = std::function<void(const std::vector<Flight>& overdue)>;

  Watchdog(FlightLog& log, const WatchdogOptions& options, GiveUp give_up);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // Whether any trial was overdue, although it may have ended since.
  bool bit() const { return bit_; }

 private:
  void Loop();
  bool Sleep(std::chrono::milliseconds time);  // false: the watch is over
  void WaitForTheRest();

  FlightLog& log_;
  const WatchdogOptions options_;
  const GiveUp give_up_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::atomic<bool> bit_ = false;
  std::thread thread_;
};

}  // namespace rockyard::batch
