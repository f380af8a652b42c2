// How an experiment is made of its parameters, for campaigns, dry runs, replays and `api`; and the
// roles of its columns, for stores.
#pragma once

#include <memory>

#include "experiments/experiment.h"
#include "experiments/experiment_set_params.h"
#include "trial/watchers.h"

namespace rockyard::experiments {

// Makes the experiment that is chosen, on `drive`. `watchers` are shown what runs see and decide,
// without any influence on the records; they must stand calls from several threads where Run is
// called from several.
inline std::unique_ptr<Experiment> MakeExperiment(const ExperimentSet& experiment,
                                                  const trial::DriveParams& drive,
                                                  const trial::Watchers& watchers = {}) {
  return experiment.chosen().Make(drive, watchers);
}

// Returns the schema of a store, which keeps names and no roles, with the roles of its columns:
// those of the experiment that knows the most of the names. A column that this experiment does not
// know (any more) stays a value, which cells do not add up.
truth::RecordSchema WithRoles(truth::RecordSchema stored);

}  // namespace rockyard::experiments
