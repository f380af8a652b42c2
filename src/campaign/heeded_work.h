// Trials that are noted in a flight log and heed the wish to stop.
#pragma once

#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "batch/executor.h"
#include "batch/flight_log.h"
#include "batch/logged_experiment.h"
#include "campaign/stop.h"
#include "core/error.h"
#include "experiments/experiment.h"

namespace rockyard::campaign {

// Passes the caller's wish on to the log.
inline void AskToStop(const Stop& stop, batch::FlightLog& log) {
  if (stop.IsWanted()) log.stop() = true;
}

// Told of the first trial in which the machine failed, while it still is in flight. Does not
// return: the process ends, and the trial stays pending.
using MachineFailed = std::function<void(batch::TrialId id, const std::exception& error)>;

// Asks after every trial whether it was the last.
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

// Experiments that note their trials in the log, heed the caller's wish to stop, and tell of a
// machine that fails.
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
  std::deque<StoppedExperiment> stopped_;
  std::deque<batch::LoggedExperiment> logged_;
  std::vector<batch::CellWork> work_;
};

}  // namespace rockyard::campaign
