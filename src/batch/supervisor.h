// Keeps a campaign going when the process that runs it dies. Campaigns and the writing of traces
// are supervised by it (campaign/campaign_process.h); StoredPlan serves every reader of a store.
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
  bool cut_short = false;    // ended by itself in the middle of its work, as by exit() in a plugin
};

// e.g. "SIGSEGV (Segmentation fault)"
std::string SignalText(int signal);

// While an object lives, polite signals (SIGINT, SIGTERM, SIGHUP, SIGUSR1; those that the caller of
// the program told to ignore stay ignored) wait until a child is waited for. There may be one
// object at a time, in a process with one thread.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

  // Forks; the child runs `work` with the former signal mask, ends with what it returns, and dies
  // with this process. Waits for the end of the child. The first polite signal is passed on to it
  // as SIGTERM; a signal that comes later than half a second after the first becomes SIGKILL.
  // Throws core::UserError where no process can be made.
  ProcessEnd Run(const std::function<int()>& work) const;

 private:
  ProcessEnd Wait(pid_t child) const;

  sigset_t held_{};
  sigset_t former_{};
  struct sigaction former_child_action_ {};
};

// A campaign without some of its trials: hands out what `source` has, but for the trials that are
// left out, which stay pending. A round of a stopping rule that has such a trial never ends; the
// source ends there.
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

// Returns the plan of a store under a rule, with its finished trials; Next has not been called. A
// store keeps its rule and not the decisions: every session that goes on and every reader of runs
// begins with this plan, so that all of them end each cell where the run did.
WorkPlan StoredPlan(const ResultStore& store, const std::optional<StoppingRule>& rule,
                    Order order = Order::kNatural);

// Returns where the cells of a store ended, one state per cell, as the rule of the store decides. A
// store without a rule has only open or planned cells. Cost: reads cell, trial and outcome of every
// row.
std::vector<CellState> StoredEnds(const ResultStore& store);

// A worker ends with this code when a trial found the machine short of memory, files or disk. Must
// differ from kOverdueExit (flight_log.h) and from the exit codes of the program (campaign/work.h),
// which pass through.
inline constexpr int kShortExit = 76;

// A trial that is left out: it stays pending, has no result, and is in no hash. A campaign with
// such a trial ends with exit code 5.
struct LeftOut {
  TrialId id;
  enum class Why { kHangs, kIsKilled, kCrashes } why = Why::kHangs;
};

// What a worker process is to do. CampaignProcess and WriteTraces carry it out.
struct Mission {
  enum class Task {
    kBegin,             // the whole campaign, as the user asked for it
    kGoOn,              // the rest of it: the store is there
    kRunAlone,          // one trial, and store it
    kStoreFault,        // store one trial as a fault: of its navigator where that is foreign
    kStoreHang,         // the same of a trial that hung twice, where its navigator is foreign
    kStoreMachineFault  // note an infrastructure fault of one trial
  };

  Task task = Task::kBegin;
  TrialId trial{};                  // of the last three
  std::string kind{};               // of the infrastructure fault
  std::string reason{};             // of either fault, a sentence without seed and trial
  std::vector<LeftOut> left_out{};  // kGoOn: not to be run
};

// Does the mission in a process of its own and returns the exit code of that process. Must not
// throw.
using Worker = std::function<int(const Mission&)>;

// How often things are tried again. The exit codes are those of campaign::Outcome.
struct SupervisorOptions {
  int hung_retries = 2;        // of a trial that used up its CPU time
  int killed_retries = 2;      // of a trial whose process was ended by SIGKILL, or kShortExit
  int fruitless_restarts = 3;  // of workers that die and store no trial
  int failed_exit = 5;         // exit code when that is too often
  int interrupted_exit = 130;  // exit code when a polite signal ended the worker
  // False for work that stores no trials, such as the writing of traces: a trial that crashes again
  // is left out there.
  bool faults_are_stored = true;
  std::string fruit = "storing a trial";  // of which fruitless workers did nothing
};

// Forks the worker, waits for it, and returns its exit code.
//
// When the worker dies by a signal, the trials that were in flight, by the log that outlives it,
// are run one by one, each in a process of its own; then another worker goes on. Records depend on
// how a trial ends when it runs alone:
//
// - A trial with two crashes, at least one of them alone, is stored as a simulator fault, or where
// a
//   plugin or process decides as a fault of the navigator. Ending in the middle of work counts as a
//   crash.
// - A trial that passes leaves an infrastructure fault behind: the machine failed, not the trial.
// - SIGKILL is no crash: it comes from outside, where memory is short. A trial that is killed alone
//   is tried again, and left out, pending, when that happens too often; no machine decides what is
//   a fault.
//
// Work that has no place for faults (faults_are_stored) is given neither of the missions that store
// one. A worker that ends with kShortExit found the machine short of memory, files or disk in a
// trial; it counts as killed. A worker that ends with kOverdueExit (flight_log.h) left hanging
// trials: each is tried again alone, and left out when it hangs again too often. Where a plugin
// decides, the second time counts as a fault of the navigator.
//
// SIGINT, SIGTERM, SIGHUP and SIGUSR1 are passed on to the worker; the second of them kills it
// (what is stored stays). The worker dies with the supervisor.
//
// Call it while the process has one thread and no open store: a fork copies the calling thread
// only, so that locks, OpenMP teams and SQLite handles of others would be dead in the child. `note`
// is given sentences for the user. Throws core::UserError where no process can be made.
int Supervise(FlightLog& log, const Worker& worker, const SupervisorOptions& options,
              const std::function<void(const std::string&)>& note);

}  // namespace rockyard::batch
