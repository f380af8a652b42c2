// The experiment of a scenario, for tests that make one from a file or from defaults.
#pragma once

#include <memory>

#include "experiments/experiment.h"
#include "scenario/scenario.h"

namespace rockyard::experiments {

inline std::unique_ptr<Experiment> MakeExperiment(const scenario::Scenario& scenario,
                                                  const trial::ScanWatcher& watcher = {}) {
  return MakeExperiment(scenario.experiment, scenario.drive, {.scan = watcher});
}

}  // namespace rockyard::experiments
