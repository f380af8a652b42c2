// Keeps a campaign going when the process that runs it dies.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "batch/campaign.h"
#include "batch/executor.h"
#include "batch/flight_log.h"
#include "batch/result_store.h"
#include "batch/work_plan.h"

namespace rockyard::batch {

// A forked process and how it ended.

struct ProcessEnd {
  int code = 0;              // exit code, where it ended by itself
  int signal = 0;            // that ended it; 0: none
  bool interrupted = false;  // this process was asked to end meanwhile
};

// e.g. "SIGSEGV (Segmentation fault)"
std::string SignalText(int signal);

// While this lives, polite signals (SIGINT, SIGTERM, SIGHUP, SIGUSR1; those that the caller of the
// program told to ignore stay ignored) wait until a child is waited for. One at a time, in a
// process with one thread.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

  // Forks; the child runs `work` with the former signal mask, ends with what it returns, and dies
  // with this process. Waits for its end; the first polite signal is passed on as SIGTERM, one that
  // comes later than a moment after it becomes SIGKILL. Throws core::UserError where no process
  // can be made.
  ProcessEnd Run(const std::function<int()>& work) const;

 private:
  ProcessEnd Wait(pid_t child) const;

  sigset_t held_{};
  sigset_t former_{};
  struct sigaction former_child_action_ {};
};

// A campaign without some of its trials.

// Hands out what `source` has, but for trials that hang or are killed: they stay pending. A round
// of a stopping rule that has one of them never ends, so that everything ends with it.
class LeavingOutSource final : public WorkSource {
 public:
  LeavingOutSource(LocalWorkSource& source, std::vector<TrialId> left_out);

  std::optional<TrialId> Take() override;
  void Finish(CellRecord record) override;
  void Close() override { source_.Close(); }

 private:
  LocalWorkSource& source_;
  const std::vector<TrialId> left_out_;
  std::mutex mutex_;
  int running_ = 0;
};

// Where the cells of a store ended, decided again from what is stored. A store keeps its rule and
// not the decisions: every session that goes on and every reader of runs begins with this plan, so
// that all of them end each cell where the run did.

// The plan of a store under a rule, with its finished trials; before the first Next.
WorkPlan StoredPlan(const ResultStore& store, const std::optional<StoppingRule>& rule,
                    Order order = Order::kNatural);

// One state per cell, as the rule of the store decides; a store without a rule has only open or
// planned cells. Cost: reads cell, trial and outcome of every row.
std::vector<CellState> StoredEnds(const ResultStore& store);

// A worker ends with this code when a trial found the machine short of memory, files or disk. As
// kOverdueExit it is none of the exit codes of the program (campaign/work.h), which pass through.
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
  int hung_retries = 2;        // of a trial that used up its CPU time
  int killed_retries = 2;      // of a trial whose process was ended by SIGKILL, or kShortExit
  int fruitless_restarts = 3;  // of workers that die and store no trial
  int failed_exit = 5;         // exit code when that is too often
  int interrupted_exit = 130;  // exit code when a polite signal ended the worker
  // False where work stores no trials, as the writing of traces: one that crashes is left out too.
  bool faults_are_stored = true;
  std::string fruit = "storing a trial";  // of which fruitless workers did nothing
};

// Forks the worker, waits for it, and returns its exit code. When it dies by a signal (a crash, the
// out-of-memory killer) the trials that were in flight, by the log that outlives it, are run one by
// one, each in a process of its own: one that crashes again (in two crashes, one of them alone) is
// stored as a simulator fault, one that passes leaves an infrastructure fault behind (the machine
// failed, not the trial); then another worker goes on. SIGKILL comes from outside, where memory is
// short: such a trial is tried again alone, and left out, pending, when it is killed again; no
// machine decides what is a fault. Work that has no place for faults (faults_are_stored) is given
// neither of the missions that store one.
// A worker that ends with kShortExit found the machine short of memory, files or disk in a trial,
// which is as if it had been killed from outside.
// A worker that ends with kOverdueExit (flight_log.h) left hanging trials: each is tried again
// alone, and left out, too, when it hangs again.
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
