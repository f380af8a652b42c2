// Tolerances of questions about what hides what.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/pose.h"

namespace rockyard::rendering {

// Surfaces this close to a point do not hide it: less than a pixel sees of the ground, and half the
// width of a beam of 3 mrad at 0.3 m.
inline constexpr double kOcclusionMargin_m = 0.0005;
// Added to the reach of rocks, so that rounding leaves none out that a ray touches.
inline constexpr double kRounding_m = 1e-9;

// The rays of a run or a tile of pixels lie within a cone about the unit vector `axis`.
struct RayCone {
  math::Vector3 axis = math::Vector3::UnitX();
  double half_sine = 0.0;
  double half_cosine = 1.0;
};

// Returns whether a ball meets the cone whose apex lies `away` before its centre.
inline bool BallMeetsCone(const math::Vector3& away, double radius_m, const RayCone& cone) {
  const double along_m = away.dot(cone.axis);
  if (along_m < -radius_m) return false;
  const double aside_m = std::sqrt(std::max(0.0, away.squaredNorm() - along_m * along_m));
  // Distance from the surface of the cone, positive outside.
  return aside_m * cone.half_cosine - along_m * cone.half_sine <= radius_m;
}

}  // namespace rockyard::rendering
