// The estimator of a drive.
#pragma once

#include <memory>

#include "localization/estimator.h"
#include "rover/rover.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Returns the one that the scenario names. An oracle sees `rover`, which stands at the start of the
// course and outlives it; all others see what the rover measures. They believe to be where the
// course starts, or go on by `memory` where it is not null.
std::unique_ptr<localization::Estimator> MakeEstimator(
    const DriveParams& drive, const rover::Rover& rover,
    const localization::EstimatorMemory* memory = nullptr);

// What an estimator of that drive begins with; `memory`, which may be null, outlives its use.
localization::EstimatorSetup EstimatorSetupOf(const DriveParams& drive,
                                              const localization::EstimatorMemory* memory);

}  // namespace rockyard::trial
