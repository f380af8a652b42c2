// The drive experiment: one trial is one closed-loop drive to the goal.
#pragma once

#include "experiments/experiment.h"
#include "scenario/scenario.h"
#include "truth/drive_record.h"

namespace rockyard::experiments {

// Names and units of a drive record, in the order of truth::kDriveColumns.
const truth::RecordSchema& DriveSchema();

class DriveExperiment final : public Experiment {
 public:
  explicit DriveExperiment(scenario::Scenario scenario);

  const truth::RecordSchema& schema() const override;
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const override;

 private:
  scenario::Scenario scenario_;
};

}  // namespace rockyard::experiments
