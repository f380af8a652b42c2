// Tolerances of questions about what hides what.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/pose.h"

namespace rockyard::rendering {

// Surfaces this close to a point do not hide it: less than a pixel sees of the ground, and half the
// width of a beam of 3 mrad at 0.3 m. One margin for all sensors that see terrain, at every
// fidelity, so that levels differ by their errors and not by what hides what.
inline constexpr double kOcclusionMargin_m = 0.0005;
// Added to the reach of rocks, so that rounding leaves none out that a ray touches.
inline constexpr double kRounding_m = 1e-9;

// The rays of a run or a tile of pixels lie within a cone about the unit vector `axis`.
struct RayCone {
  math::Vector3 axis = math::Vector3::UnitX();
  double half_sine = 0.0;
  double half_cosine = 1.0;

  // The cone of the unit vectors no farther from `axis` than a chord: c belongs to the angle a with
  // c = 2 sin(a / 2), so cos a = 1 - c^2 / 2. None is wider than a half-space, which holds all
  // there is to see.
  static RayCone Around(const math::Vector3& axis, double chord) {
    const double cosine = std::max(0.0, 1.0 - 0.5 * chord * chord);
    return {axis, std::sqrt(1.0 - cosine * cosine), cosine};
  }
};

// Returns whether a ball meets the cone whose apex lies `away` before its centre.
inline bool BallMeetsCone(const math::Vector3& away, double radius_m, const RayCone& cone) {
  const double along_m = away.dot(cone.axis);
  if (along_m < -radius_m) return false;
  const double aside_m2 = std::max(0.0, away.squaredNorm() - along_m * along_m);
  // The distance from the surface of the cone, aside cos - along sin, is positive outside. Both
  // sides of the comparison are positive, as the ball does not lie behind the apex.
  const double most_m = radius_m + along_m * cone.half_sine;
  return aside_m2 * cone.half_cosine * cone.half_cosine <= most_m * most_m;
}

}  // namespace rockyard::rendering
