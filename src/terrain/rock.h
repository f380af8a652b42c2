// The one rock geometry that physics, sensors and plots share: an ellipsoid with two horizontal
// axes turned by yaw and one vertical axis, partly below the ground, or a cap that stands on it
// (rock_profile.h).
#pragma once

#include "math/pose.h"

namespace rockyard::terrain {

struct Rock {
  math::Vector3 center_W = math::Vector3::Zero();     // of the ellipsoid or of a cap's base, m
  math::Vector3 semi_axes_m = math::Vector3::Ones();  // along its own x, y, z; x >= y
  double yaw_rad = 0.0;                               // of the rock's x axis from world x
  // 0 for the whole ellipsoid. For a cap its growth A below 2: at the share s of its height
  // semi_axes_m.z() below its top it is as wide as sqrt(A s + (1 - A) s^2) times its base. It lies
  // within the ellipsoid of that centre and those semi-axes.
  double cap_growth = 0.0;
  double diameter_m = 0.0;  // as drawn from the size law: the largest horizontal axis, 2 a
  double height_m = 0.0;    // of the top above the ground at the centre
};

}  // namespace rockyard::terrain
