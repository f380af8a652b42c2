// The processes of a campaign: a supervised worker, or the ranks that mpirun started.
#pragma once

#include <atomic>
#include <functional>
#include <span>
#include <vector>

#include "app/exit_code.h"
#include "batch/communicator.h"
#include "batch/executor.h"
#include "batch/flight_log.h"
#include "batch/result_store.h"
#include "batch/supervisor.h"

namespace rockyard::app {

struct ContainmentOptions {
  bool supervisor = true;            // not under mpirun
  double trial_cpu_limit_s = 600.0;  // 0: none
  int threads = 0;                   // of this process; 0: as many as the machine runs at once
};

// What `rockyard run` and `rockyard sweep` do is done in a process that is told by this which part
// of it is wanted.
class CampaignProcess {
 public:
  CampaignProcess(const ContainmentOptions& options, const batch::Mission& mission,
                  batch::FlightLog& log, batch::Communicator* communicator);

  // False: another process was here before and died: open the store to go on, whatever the user
  // said of an existing one, and say nothing of it.
  bool begins() const { return mission_.task == batch::Mission::Task::kBegin; }
  // False: after opening, DoTask and nothing else: no trials, no report.
  bool whole() const { return begins() || mission_.task == batch::Mission::Task::kGoOn; }
  int threads() const { return options_.threads; }
  int ranks() const { return communicator_ == nullptr ? 1 : communicator_->size(); }

  // Runs the trials that the store lacks, on all ranks, under a watchdog; ends early on polite
  // signals. As batch::RunBatch, whose `threads` is taken from here.
  batch::BatchResult RunTrials(std::span<const batch::CellWork> work, batch::ResultStore& store,
                               batch::BatchOptions options,
                               const batch::ProgressReport& report = {});

  // Does more work with the stored trials, as the mission says, in this process: until it ends, or
  // polite signals set the log's stop flag.
  ExitCode Afterwards(
      const std::function<ExitCode(const batch::Mission& mission, batch::FlightLog& log)>& work);

  // Whether polite signals came while trials ran.
  bool interrupted() const { return log_.stop(); }
  // The result is told once, whatever dies after it.
  bool reported() const { return log_.reported(); }
  void SetReported() { log_.SetReported(); }

  // The task for one trial.
  ExitCode DoTask(std::span<const batch::CellWork> work, batch::ResultStore& store);

  // Tells of every trial that was left out, pending, as it hangs or is killed; true where there is
  // one.
  bool TellLeftOut(const batch::ResultStore& store) const;

 private:
  // Neither a supervisor nor mpirun decides when patience ends.
  bool alone() const { return !options_.supervisor && communicator_ == nullptr; }

  const ContainmentOptions& options_;
  const batch::Mission& mission_;
  batch::FlightLog& log_;
  batch::Communicator* communicator_;
};

using CampaignPart = std::function<ExitCode(CampaignProcess&)>;

// Runs `body` as the user asked: in a supervised worker (and again after a crash), in this process,
// or, under mpirun, on rank 0 while the others serve it. `body` opens the store named by the
// command line and calls either RunTrials or DoTask. Call it before the process has a second
// thread. Returns the exit code, the same on every rank.
//
// `afterwards`, where given, calls Afterwards. It runs in the same manner once `body` has ended
// with all trials, in a worker of its own, so that what dies there starts no trial and tells no
// result again. It stores no faults: trials that end its process each time come back in the
// mission as left out. Its exit code counts where it is not kDone.
ExitCode RunContained(ContainmentOptions options, const CampaignPart& body,
                      const CampaignPart& afterwards = {});

// The command that runs the trial again. `cell` as in the store.
std::string ReplayLine(const batch::ResultStore& store, batch::TrialId id);

}  // namespace rockyard::app
