// The estimator of a drive.
#pragma once

#include <memory>

#include "localization/estimator.h"
#include "rover/rover.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Returns the one that the scenario names. An oracle sees `rover`, which stands at the start of the
// course and outlives it; all others see what the rover measures.
std::unique_ptr<localization::Estimator> MakeEstimator(const DriveParams& drive,
                                                       const rover::Rover& rover);

}  // namespace rockyard::trial
