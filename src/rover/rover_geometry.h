// Where the parts of the rover are, in frame R while it stands on level ground.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "messages/calibration.h"
#include "messages/wheels.h"
#include "rover/rover_layout_params.h"
#include "rover/rover_params.h"

namespace rockyard::rover {

// Returns the true drive geometry, of which on-board code gets a copy.
messages::DriveCalibration MakeDriveCalibration(const RoverParams& params);

// Returns the sinkage up to which the law of the rut holds, m: a sixth of the wheel's diameter
// (Wong 2008 sec. 2.5).
inline double LargestLawfulSinkage(const RoverGeometryParams& params) {
  return params.wheel_radius_m / 3.0;
}

// A closed outline seen from above: corners (x, y) in R, m, counter-clockwise.
using Outline = std::vector<std::pair<double, double>>;
Outline BodyOutline(const RoverGeometryParams& params);   // overall length by width
Outline BellyOutline(const RoverGeometryParams& params);  // underside of the chassis
std::array<Outline, messages::kWheelCount> WheelOutlines(const RoverGeometryParams& params);

}  // namespace rockyard::rover
