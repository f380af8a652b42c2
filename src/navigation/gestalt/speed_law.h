// How fast a curve is driven.
#pragma once

#include "navigation/gestalt/speed_law_params.h"

namespace rockyard::navigation {

// Returns the share of the full speed, from min_speed_share to 1, at the curvature c of either
// sign:
//   1 up to c_full, 1 - (1 - p_min) (|c| - c_full) / (c_slow - c_full) up to c_slow, p_min beyond.
double SpeedShare(const SpeedLawParams& params, double curvature_per_m);

}  // namespace rockyard::navigation
