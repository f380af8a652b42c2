// The steepest slope on which soil holds a braked rover.
#pragma once

#include "rover/rover_params.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

// Returns the inclination in [0, pi/2] at which the pull down the slope reaches what the soil bears
// across a braked wheel, whatever the rover's heading:
//   tan(slope) = T_max(N) / N,   N = W cos(slope) / 6,
// with each wheel under the mean load (wheel_rut_params.h). Wheels that point up or down the slope
// bear their resistance R more.
double SteepestHeldSlope_rad(const RoverParams& params, const terrain::SoilParams& soil);

}  // namespace rockyard::rover
