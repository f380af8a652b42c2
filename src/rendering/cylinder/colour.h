// Light and surfaces in three channels.
#pragma once

#include <Eigen/Core>
#include <array>

namespace rockyard::rendering {

// Red, green, blue: reflectances, irradiances or radiances, all in proportion to light (no gamma).
using Colour = Eigen::Array3d;

// A colour as a parameter: three numbers of a list.
using ColourValues = std::array<double, 3>;

inline Colour ToColour(const ColourValues& values) { return {values[0], values[1], values[2]}; }

}  // namespace rockyard::rendering
