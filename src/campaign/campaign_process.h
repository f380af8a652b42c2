// The processes of a campaign: a supervised worker, or the ranks that mpirun started. Running
// scenarios and sweeps (run_campaign.h) goes through it; the writing of traces runs in its
// processes.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "batch/batch_session.h"
#include "batch/campaign.h"
#include "batch/communicator.h"
#include "batch/distributed.h"
#include "batch/executor.h"
#include "batch/flight_log.h"
#include "batch/result_store.h"
#include "batch/supervisor.h"
#include "campaign/journal.h"
#include "campaign/stop.h"
#include "campaign/work.h"
#include "core/error.h"
#include "experiments/experiment.h"

namespace rockyard::campaign {

// Returns whether this process is rank 0 of those that mpirun started, or was started alone.
// Remarks that every rank could make are made by it alone.
bool IsFirstRank();

struct ContainmentOptions {
  bool supervisor = true;            // not under mpirun
  double trial_cpu_limit_s = 600.0;  // 0: none
  double rank_silence_s = 60.0;      // under mpirun; 0: waits for ever
  int threads = 0;                   // of this process; 0: as many as the machine runs at once
};

// How a piece of work speaks with whoever asked for it.
struct Contact {
  Journal& journal;
  const Stop& stop;
};

// What a process of a campaign may do, and which part of the campaign is wanted of it. Running a
// scenario or a sweep is done through it alone.
class CampaignProcess {
 public:
  CampaignProcess(const ContainmentOptions& options, const batch::Mission& mission,
                  batch::FlightLog& log, batch::Communicator* communicator, const Contact& contact);

  // Returns false where another process was here before and died: then open the store to go on,
  // whatever the user said of an existing run, and say nothing of it.
  bool begins() const { return mission_.task == batch::Mission::Task::kBegin; }
  // Notes that the folder belongs to this campaign: whatever dies from here on, the next process
  // finds it as its own.
  void SetOpened() { log_.SetOpened(); }
  // Returns false where, after opening, DoTask is to be called and nothing else: no trials, no
  // report.
  bool whole() const { return begins() || mission_.task == batch::Mission::Task::kGoOn; }
  int threads() const { return options_.threads; }
  int ranks() const { return communicator_ == nullptr ? 1 : communicator_->size(); }

  // Runs the trials that the store lacks, on all ranks, under a watchdog; ends early where the
  // caller wishes it. It does what batch::RunBatch does, with the threads of the containment in
  // place of `options.threads`.
  batch::BatchResult RunTrials(std::span<const batch::CellWork> work, batch::ResultStore& store,
                               batch::BatchOptions options,
                               const batch::ProgressReport& report = {});

  // Does more work with the stored trials, as the mission says, in this process, until the work
  // ends or the caller's wish sets the stop flag of the log.
  Outcome Afterwards(
      const std::function<Outcome(const batch::Mission& mission, batch::FlightLog& log)>& work);

  // Returns whether the caller wished for an end while trials ran.
  bool interrupted() const { return log_.stop(); }
  // Returns whether a trial used more CPU time than it may, and ended all the same. No trial was
  // begun after it then.
  bool late_trial() const { return late_trial_; }
  // Whether the result was told: it is told once, whatever dies after it.
  bool reported() const { return log_.reported(); }
  void SetReported() { log_.SetReported(); }

  // Does the task for one trial.
  Outcome DoTask(std::span<const batch::CellWork> work, batch::ResultStore& store);

  // Tells of every trial that was left out and stays pending, as it hangs or is killed, also on
  // another rank. Returns whether there is one.
  bool TellLeftOut(const batch::ResultStore& store) const;

 private:
  void RunOnRanks(std::span<const batch::CellWork> work, batch::ResultStore& store,
                  batch::BatchSession& session, int threads);
  // Notes an infrastructure fault of each trial that hangs, on this rank or another.
  static void NoteOverdue(batch::ResultStore& store, const std::vector<batch::TrialId>& trials);

  // Whether neither a supervisor nor mpirun decides when patience ends.
  bool alone() const { return !options_.supervisor && communicator_ == nullptr; }

  const ContainmentOptions& options_;
  const batch::Mission& mission_;
  batch::FlightLog& log_;
  batch::Communicator* communicator_;
  const Contact& contact_;
  batch::OverdueTrials overdue_;  // of this rank
  std::vector<batch::TrialId> overdue_elsewhere_;
  bool late_trial_ = false;
};

using CampaignPart = std::function<Outcome(CampaignProcess&)>;

// Runs `body` as the options ask: in a supervised worker (and again after a crash), in this
// process, or, under mpirun, on rank 0 while the others serve it. `body` opens the store named by
// the request and calls either RunTrials or DoTask; an exception out of it becomes an outcome
// (Guarded). With a supervisor call RunContained before the process has a second thread. Returns
// the outcome, the same on every rank.
//
// `afterwards`, where given, calls Afterwards. It runs in the same manner once `body` has ended
// with all trials, in a worker of its own, so that what dies there starts no trial and tells no
// result again. It stores no faults: trials that end its process each time come back in the mission
// as left out. Its outcome counts where it is not kDone.
//
// A process that nobody watches over (no supervisor, or rank 0) ends with kFailed where a trial has
// used up its CPU time: a thread cannot be stopped from outside. Where another rank has such a
// trial, the campaign goes on without that rank and trial.
Outcome RunContained(ContainmentOptions options, const Contact& contact, const CampaignPart& body,
                     const CampaignPart& afterwards = {});

// Returns the command that runs the trial again. `id.cell` is the number of the cell in the store.
std::string ReplayLine(const batch::ResultStore& store, batch::TrialId id);

// Passes the caller's wish on to the log.
inline void AskToStop(const Stop& stop, batch::FlightLog& log) {
  if (stop.IsWanted()) log.stop() = true;
}

// Told of the first trial in which the machine failed, while that trial still is in flight. It must
// not return: the process ends, and the trial stays pending.
using MachineFailed = std::function<void(batch::TrialId id, const std::exception& error)>;

// An experiment that asks after every trial whether that was the last.
class StoppedExperiment final : public experiments::Experiment {
 public:
  StoppedExperiment(const experiments::Experiment& experiment, int cell, const Stop& stop,
                    batch::FlightLog& log, const MachineFailed& machine_failed)
      : experiment_(experiment),
        cell_(cell),
        stop_(stop),
        log_(log),
        machine_failed_(machine_failed) {}

  const truth::RecordSchema& schema() const override { return experiment_.schema(); }

  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override {
    try {
      truth::Record record = experiment_.Run(seed, index);
      AskToStop(stop_, log_);
      return record;
    } catch (const std::exception& error) {
      if (core::IsMachineFailure(error)) {
        machine_failed_({cell_, static_cast<std::int64_t>(index)}, error);
      }
      throw;
    }
  }

 private:
  const experiments::Experiment& experiment_;
  int cell_;
  const Stop& stop_;
  batch::FlightLog& log_;
  const MachineFailed& machine_failed_;
};

// The work of a campaign with experiments that note their trials in the log, heed the caller's wish
// to stop, and tell of a machine that fails.
class HeededWork {
 public:
  HeededWork(std::span<const batch::CellWork> work, batch::FlightLog& log, const Stop& stop,
             MachineFailed machine_failed)
      : machine_failed_([this, told = std::move(machine_failed)](batch::TrialId id,
                                                                 const std::exception& error) {
          const std::lock_guard lock(mutex_);  // held to the end of the process
          told(id, error);
        }) {
    for (const batch::CellWork& cell : work) {
      const int number = static_cast<int>(work_.size());
      // The logged experiment must be the outer one: when the machine fails, the trial is still in
      // flight, by which it is found again.
      const auto& stopped =
          stopped_.emplace_back(*cell.experiment, number, stop, log, machine_failed_);
      const auto& logged = logged_.emplace_back(stopped, number, log);
      work_.push_back({&logged, cell.seed});
    }
  }

  std::span<const batch::CellWork> work() const { return work_; }

 private:
  std::mutex mutex_;
  MachineFailed machine_failed_;
  std::deque<StoppedExperiment> stopped_;  // deques: logged_ and work_ point into them
  std::deque<batch::LoggedExperiment> logged_;
  std::vector<batch::CellWork> work_;
};

}  // namespace rockyard::campaign
