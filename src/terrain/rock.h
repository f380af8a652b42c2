// The one rock geometry that physics, sensors and plots share: an ellipsoid with two horizontal
// axes turned by yaw and one vertical axis, partly below the ground.
#pragma once

#include "math/pose.h"

namespace rockyard::terrain {

struct Rock {
  math::Vector3 center_W = math::Vector3::Zero();     // of the ellipsoid, m
  math::Vector3 semi_axes_m = math::Vector3::Ones();  // along its own x, y, z; x >= y
  double yaw_rad = 0.0;                               // of the ellipsoid's x axis from world x
  double diameter_m = 0.0;  // as drawn from the size law: the largest horizontal axis, 2 a
  double height_m = 0.0;    // of the top above the ground at the centre
};

}  // namespace rockyard::terrain
