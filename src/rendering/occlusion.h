// What hides what: the margin that all sensors share, and cones of rays that say which rocks a
// bundle of pixels may see. The geometric light stripe, the error model of stereo, shades and
// images use the margin; only images use the cones.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/pose.h"

namespace rockyard::rendering {

// Surfaces this close to a point do not hide it. The margin is smaller than a pixel on the ground,
// and about half the width of a beam of 3 mrad at 0.3 m. It must be the same for all sensors that
// see terrain, at every fidelity, so that fidelities differ by their errors and not by what hides
// what. The records of all of them depend on it.
inline constexpr double kOcclusionMargin_m = 0.0005;
// Is added to the radius of balls around rocks, so that rounding leaves out no rock that a ray
// touches.
inline constexpr double kRounding_m = 1e-9;

// A cone about the unit vector `axis` that holds all rays of a run or a tile of pixels. It only
// says which rocks are asked: it may be too wide, never too narrow.
struct RayCone {
  math::Vector3 axis = math::Vector3::UnitX();
  double half_sine = 0.0;
  double half_cosine = 1.0;

  // Returns the cone of the unit vectors at a distance of up to `chord` from `axis`. A chord c
  // belongs to the angle a with c = 2 sin(a / 2), so cos a = 1 - c^2 / 2. Cones end at the
  // half-space: `chord` should be at most sqrt(2).
  static RayCone Around(const math::Vector3& axis, double chord) {
    const double cosine = std::max(0.0, 1.0 - 0.5 * chord * chord);
    return {axis, std::sqrt(1.0 - cosine * cosine), cosine};
  }
};

// Returns whether a ball may meet the cone; false only where it does not. `away` leads from the
// apex of the cone to the centre of the ball.
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
