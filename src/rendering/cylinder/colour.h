// Light and surfaces in three channels.
#pragma once

#include <Eigen/Core>

#include "rendering/cylinder/cylinder_params.h"

namespace rockyard::rendering {

// Red, green, blue: reflectances, irradiances or radiances, all in proportion to light (no gamma).
using Colour = Eigen::Array3d;

inline Colour ToColour(const ColourValues& values) { return {values[0], values[1], values[2]}; }

}  // namespace rockyard::rendering
