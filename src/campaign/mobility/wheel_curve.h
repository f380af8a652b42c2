// One wheel that moves steadily over level soil under a given load, at one slip after another: the
// pull that it leaves for others, its torque and its sinkage. The command `mobility` draws them.
#pragma once

#include <vector>

#include "rover/rover_params.h"
#include "rover/steady_wheel.h"
#include "terrain/soil_params.h"

namespace rockyard::campaign {

struct WheelPoint {
  double slip = 0.0;
  double load_N = 0.0;
  rover::SteadyForces forces;
};

// Returns what a wheel of the rover does under its mean load on level ground, at slips of
// (i / 50)^2 for i from 0 to 49 (rover/steady_wheel.h).
std::vector<WheelPoint> WheelCurve(const rover::RoverParams& params,
                                   const terrain::SoilParams& soil);

}  // namespace rockyard::campaign
