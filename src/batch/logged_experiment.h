// An experiment that notes in a flight log which trial runs.
#pragma once

#include "batch/flight_log.h"
#include "experiments/experiment.h"

namespace rockyard::batch {

// The records are those of `experiment`, the trials those of one cell. Both arguments must outlive
// this.
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

}  // namespace rockyard::batch
