// Small scenarios of the experiment "hazard_detection" for tests.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiments/scenario_experiment.h"
#include "scenario/shipped.h"

namespace rockyard::experiments {

// A shipped scenario with changes.
inline scenario::Scenario HazardScenario(const std::string& name,
                                         std::vector<std::string> overrides = {}) {
  return scenario::Shipped("hazard_detection/" + name, overrides);
}

// One column of run 0, added up over the given number of scenes.
inline double Count(const scenario::Scenario& scenario, const std::string& column,
                    std::uint64_t run = 0) {
  const auto experiment = MakeExperiment(scenario);
  return ValueOf(experiment->schema(), Measure(*experiment, 1, run), column);
}

}  // namespace rockyard::experiments
