// The experiment "drive": one trial is one closed-loop drive to the goal. Campaigns make it by
// make_experiment.h; replays and traces make it themselves, for RunTraced.
#pragma once

#include "experiments/experiment.h"
#include "trial/drive_params.h"
#include "trial/watchers.h"
#include "truth/drive_record.h"
#include "truth/trace.h"

namespace rockyard::experiments {

// Returns names, units and meanings of a drive record, in the order of truth::kDriveColumns.
const truth::RecordSchema& DriveSchema();

// Returns the columns of a record of these drives: DriveSchema, then the own values of every
// navigator and then of every estimator that the scenario could choose, named <navigator>.<value>.
// Those of what is not chosen are NaN, so that cells of a sweep over them have the same columns.
truth::RecordSchema DriveSchema(const trial::DriveParams& drive);

class DriveExperiment final : public Experiment {
 public:
  explicit DriveExperiment(trial::DriveParams params, trial::Watchers watchers = {});

  const truth::RecordSchema& schema() const override;
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

  // Returns the same record as Run; the course of the drive goes to `trace`, up to the fault where
  // there is one.
  truth::Record RunTraced(std::uint64_t seed, std::uint64_t index, truth::Trace& trace) const;

 private:
  truth::Record RunTrial(std::uint64_t seed, std::uint64_t index, truth::Trace* trace) const;

  trial::DriveParams params_;
  trial::Watchers watchers_;
  truth::RecordSchema schema_;
};

}  // namespace rockyard::experiments
