// The estimators that every scenario can name.
#pragma once

#include "localization/estimator_set_params.h"

namespace rockyard::trial {

// The one list of them: dead_reckoning (chosen), oracle.
localization::EstimatorSet StandardEstimators();

}  // namespace rockyard::trial
