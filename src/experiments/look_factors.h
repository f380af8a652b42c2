// Factors of cells that change what a rover's cameras see.
#pragma once

#include <string_view>
#include <vector>

#include "trial/drive_params.h"

namespace rockyard::experiments {

// The drive of one cell: `values` of the columns soil_graininess, sun_elevation_deg and baseline_m
// in place of the scenario's own; other columns change nothing.
trial::DriveParams WithLookFactors(trial::DriveParams drive,
                                   const std::vector<std::string_view>& columns,
                                   const std::vector<double>& values);

}  // namespace rockyard::experiments
