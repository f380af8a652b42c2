// Which trials are in the air, in memory that outlives the process that runs them, and a watchdog
// that ends a process in which a trial hangs. The supervisor reads it after a crash; campaigns and
// the writing of traces note their trials in it.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "batch/campaign.h"
#include "experiments/experiment.h"

namespace rockyard::batch {

// A trial that has begun and not ended.
struct Flight {
  TrialId id;
  bool overdue = false;  // has used up its CPU time
};

// A log of the flights, shared between a supervisor and the worker that it forks (anonymous shared
// memory, lock-free atomics): when the worker dies, the supervisor still reads what was in flight.
// Must be made before the fork. It is of use without a supervisor too, for the watchdog. Any thread
// of the worker may call it; each slot has one writer. Cost of a trial: some atomic writes and one
// reading of a clock.
class FlightLog {
 public:
  static constexpr int kSlots = 4096;  // trials at the same time

  // Throws core::UserError where the machine has no memory.
  FlightLog();
  ~FlightLog();
  FlightLog(const FlightLog&) = delete;
  FlightLog& operator=(const FlightLog&) = delete;

  // Notes that a trial begins on the calling thread. Returns its slot.
  int Begin(TrialId id);
  // Notes that the trial of the slot has ended.
  void End(int slot);

  std::vector<Flight> Flights() const;

  // How many trials the worker has stored since Clear; where it writes traces, how many traces.
  void SetStored(std::int64_t trials) { shared_->stored = trials; }
  std::int64_t stored() const { return shared_->stored; }

  // Marks every flight that has used more CPU time than the limit; returns whether any flight is
  // overdue. Call it only in the process that runs the flights: it reads the clocks of the threads,
  // in tests by `now_ns`.
  using CpuClock = std::function<std::int64_t(clockid_t clock)>;
  bool MarkOverdue(double limit_s, const CpuClock& now_ns = ReadCpuClock);

  // The flag that tells the worker to begin no further trial.
  std::atomic<bool>& stop() { return shared_->stop; }

  // Notes that the worker is about to make its store, or goes on with it. A later worker then goes
  // on with that store, and makes it where it is not there yet.
  void SetOpened() { shared_->opened = true; }
  bool opened() const { return shared_->opened; }

  // Notes that the user has been told the result: a later worker does not tell it again.
  void SetReported() { shared_->reported = true; }
  bool reported() const { return shared_->reported; }

  // Notes that the work of a process has come to its end. A process that ends without it was ended
  // by code that it ran, such as a plugin's exit().
  void SetReturned() { shared_->returned = true; }
  bool returned() const { return shared_->returned; }

  // Forgets flights, count, the stop flag and returned(); opened() and reported() stay. The
  // supervisor calls it before another worker starts.
  void Clear();

 private:
  static std::int64_t ReadCpuClock(clockid_t clock);

  // The state in the lowest bits of a slot's word. Above them stands the number of the flight, so
  // that the word of a flight that has ended never comes back.
  enum State : std::uint64_t { kFree, kClaimed, kFlying, kOverdue };
  static constexpr std::uint64_t kStates = 4;
  static std::uint64_t StateOf(std::uint64_t word) { return word % kStates; }

  struct alignas(64) Slot {
    std::atomic<std::uint64_t> word = kFree;
    std::atomic<std::int32_t> cell = 0;
    std::atomic<std::int64_t> trial = 0;
    std::atomic<std::int32_t> clock = 0;  // of the thread's CPU time
    std::atomic<std::int64_t> began_ns = 0;
  };
  static_assert(std::atomic<std::int64_t>::is_always_lock_free, "shared between processes");

  struct Shared {
    std::atomic<std::int64_t> stored = 0;
    std::atomic<bool> stop = false;
    std::atomic<bool> opened = false;
    std::atomic<bool> reported = false;
    std::atomic<bool> returned = false;
    Slot slots[kSlots];
  };

  Shared* shared_ = nullptr;
};

// An experiment that notes in a flight log which trial runs. Its records are those of `experiment`,
// its trials those of one cell. `experiment` and `log` must outlive it.
class LoggedExperiment final : public experiments::Experiment {
 public:
  LoggedExperiment(const experiments::Experiment& experiment, int cell, FlightLog& log)
      : experiment_(experiment), cell_(cell), log_(log) {}

  const truth::RecordSchema& schema() const override { return experiment_.schema(); }

  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override {
    const Entry entry(log_, {cell_, static_cast<std::int64_t>(index)});
    return experiment_.Run(seed, index);
  }

 private:
  // Ends the flight also when the trial throws.
  class Entry {
   public:
    Entry(FlightLog& log, TrialId id) : log_(log), slot_(log.Begin(id)) {}
    ~Entry() { log_.End(slot_); }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

   private:
    FlightLog& log_;
    int slot_;
  };

  const experiments::Experiment& experiment_;
  int cell_;
  FlightLog& log_;
};

// A worker ends with this code when a trial has used up its CPU time. Must differ from kShortExit
// (supervisor.h) and from the exit codes of the program (campaign/work.h).
inline constexpr int kOverdueExit = 75;

// What the store says of a trial that used up its CPU time: kind and reason of an infrastructure
// fault.
inline constexpr const char* kOverdueKind = "cpu_time_limit";
inline constexpr const char* kOverdueReason = "the trial used more CPU time than --trial-cpu-limit";

std::vector<TrialId> TrialsOf(const std::vector<Flight>& flights);

struct WatchdogOptions {
  double cpu_limit_s = 600.0;  // of one trial; 0: none, and no thread is started
  std::chrono::milliseconds look_every{500};
  // From the end of the last trial that is not overdue to the end of the process: the writer of the
  // store needs that time to store the trial. Must be longer than BatchOptions::interval and a
  // commit.
  std::chrono::milliseconds grace{1500};
};

// A thread that reads the CPU clock of every thread with a trial. As soon as one trial has used
// more than the limit, no further trial begins; the trials that are not overdue end and are stored;
// then `give_up` is called with the overdue ones. It is expected to end the process, as a thread
// cannot be stopped from outside. CPU time counts, not wall time, so that no trial is overdue
// because the machine is busy or suspended. No result depends on it: an overdue trial leaves no
// record.
class Watchdog {
 public:
  using GiveUp = std::function<void(const std::vector<Flight>& overdue)>;

  Watchdog(FlightLog& log, const WatchdogOptions& options, GiveUp give_up);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  // Returns whether any trial was overdue, although it may have ended since.
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
