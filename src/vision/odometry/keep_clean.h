// Which windows show one surface only.
#pragma once

#include <span>

#include "vision/odometry/odometer_params.h"

namespace rockyard::vision {

// The residual, grey levels, up to which windows are used: PlacementParams::max_residual_ratio
// times the lower quartile of all, or as large as `min_kept` of them need. Windows across a rock's
// edge do not fit any plane; what they show of the background biases them all to one side.
double ResidualLimit(std::span<const double> residuals, const PlacementParams& params);

}  // namespace rockyard::vision
