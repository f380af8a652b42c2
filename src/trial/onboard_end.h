// What the on-board side leaves at the end of a drive. The drive passes it on to its result
// (run_trial.h) and looks at none of it. Must stay: nothing here is a truth.
#pragma once

#include <vector>

#include "localization/estimator.h"

namespace rockyard::trial {

// What the parts of a drive count for themselves, as their kinds declare it.
struct OwnValues {
  std::vector<double> navigator;
  std::vector<double> estimator;
};

struct OnboardEnd {
  OwnValues own_values;
  localization::EstimatorMemory memory;  // for the next drive
};

}  // namespace rockyard::trial
