// Keeps a campaign going when the process that runs it dies.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "batch/campaign.h"
#include "batch/flight_log.h"

namespace rockyard::batch {

// A worker ends with this code when a trial found the machine short of memory, files or disk.
inline constexpr int kShortExit = 76;

// A trial that stays pending, as what it needs is not there: no result, in no hash, exit code 5.
struct LeftOut {
  TrialId id;
  enum class Why { kHangs, kIsKilled, kCrashes } why = Why::kHangs;
};

// What a worker process is to do.
struct Mission {
  enum class Task {
    kBegin,             // the whole campaign, as the user asked for it
    kGoOn,              // the rest of it: the store is there
    kRunAlone,          // one trial, and store it
    kStoreFault,        // store one trial as a simulator fault
    kStoreMachineFault  // note an infrastructure fault of one trial
  };

  Task task = Task::kBegin;
  TrialId trial{};                  // of the last three
  std::string kind{};               // of the infrastructure fault
  std::string reason{};             // of either fault, a sentence without seed and trial
  std::vector<LeftOut> left_out{};  // kGoOn: not to be run
};

// Does the mission in a process of its own and returns its exit code. Must not throw.
using Worker = std::function<int(const Mission&)>;

// How often things are tried again.
struct SupervisorOptions {
  int hung_retries = 2;           // of a trial that used up its CPU time
  int killed_retries = 2;         // of a trial whose process was ended by SIGKILL, or kShortExit
  int fruitless_restarts = 3;     // of workers that die and store no trial
  int failed_exit = 5;            // exit code when that is too often
  int interrupted_exit = 130;     // exit code when a polite signal ended the worker
  bool faults_are_stored = true;  // false: a trial that crashes is left out as well
  std::string fruit = "storing a trial";  // of which fruitless workers did nothing
};

// Forks the worker, waits for it, and returns its exit code. When it dies by a signal (a crash, the
// out-of-memory killer) the trials that were in flight are run one by one, each in a process of its
// own: one that crashes again (in two crashes, one of them alone) is stored as a simulator fault,
// one that passes leaves an infrastructure fault behind (the machine failed, not the trial); then
// another worker goes on. SIGKILL comes from outside, where memory is short: such a trial is tried
// again alone, and left out, pending, when it is killed again; no machine decides what is a fault.
// Work that has no place for faults (faults_are_stored) is given neither of the missions that store
// one.
// A worker that ends with kShortExit found the machine short of memory, files or disk in a trial,
// which is as if it had been killed from outside.
// A worker that ends with kOverdueExit (watchdog.h) left hanging trials: each is tried again alone,
// and left out, too, when it hangs again.
//
// SIGINT, SIGTERM, SIGHUP and SIGUSR1 are passed on to the worker; the second one kills it (what is
// stored stays). The worker dies with the supervisor.
//
// Call it while the process has one thread and no open store: a fork copies the calling thread
// only, so that locks, OpenMP teams and SQLite handles of others would be dead in the child.
// `note` is given sentences for the user. Throws core::UserError where no process can be made.
int Supervise(FlightLog& log, const Worker& worker, const SupervisorOptions& options,
              const std::function<void(const std::string&)>& note);

}  // namespace rockyard::batch
