// Trials that are noted in a flight log and heed the wish to stop.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "batch/executor.h"
#include "batch/flight_log.h"
#include "batch/logged_experiment.h"
#include "campaign/stop.h"
#include "experiments/experiment.h"

namespace rockyard::campaign {

// Passes the caller's wish on to the log.
inline void AskToStop(const Stop& stop, batch::FlightLog& log) {
  if (stop.IsWanted()) log.stop() = true;
}

// Asks after every trial whether it was the last.
class StoppedExperiment final : public experiments::Experiment {
 public:
  StoppedExperiment(const experiments::Experiment& experiment, const Stop& stop,
                    batch::FlightLog& log)
      : experiment_(experiment), stop_(stop), log_(log) {}

  const truth::RecordSchema& schema() const override { return experiment_.schema(); }

  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override {
    truth::Record record = experiment_.Run(seed, index);
    AskToStop(stop_, log_);
    return record;
  }

 private:
  const experiments::Experiment& experiment_;
  const Stop& stop_;
  batch::FlightLog& log_;
};

// Experiments that note their trials in the log, and heed the caller's wish to stop.
class HeededWork {
 public:
  HeededWork(std::span<const batch::CellWork> work, batch::FlightLog& log, const Stop& stop) {
    for (const batch::CellWork& cell : work) {
      const auto& stopped = stopped_.emplace_back(*cell.experiment, stop, log);
      const auto& logged = logged_.emplace_back(stopped, static_cast<int>(work_.size()), log);
      work_.push_back({&logged, cell.seed});
    }
  }

  std::span<const batch::CellWork> work() const { return work_; }

 private:
  std::deque<StoppedExperiment> stopped_;
  std::deque<batch::LoggedExperiment> logged_;
  std::vector<batch::CellWork> work_;
};

}  // namespace rockyard::campaign
