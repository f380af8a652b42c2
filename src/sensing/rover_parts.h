// What of a rover its own cameras see: the one shape that images, masks and shadows of all sensors
// take. Records of drives by images depend on it, and those of the stereo error model where shade
// drops points.
#pragma once

#include "rendering/rover_body.h"
#include "rover/rover_geometry_params.h"

namespace rockyard::sensing {

// Returns chassis and solar panel as boxes, and the wheels where they are on level ground; the thin
// arms are left out.
rendering::RoverBody MakeRoverBody(const rover::RoverGeometryParams& params);

}  // namespace rockyard::sensing
