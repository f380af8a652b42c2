// The profile of a rock between its top and the ground, from a dome to nearly a cone.
//
// In the rock's own frame let rho^2 = (x/a)^2 + (y/b)^2 and s = (top - z) / h, so that s is 0 at
// the top and 1 on the ground. All rocks are quadrics
//   rho^2 = A s + B s^2,   widest part rho = 1.
// The ellipsoid of vertical semi-axis c has A = 2 h / c and B = -A^2 / 4; with the share beta of
// its full height 2 c below the ground A = 4 (1 - beta). Below A = 2 its widest part would lie
// under the ground; there the outline is kept on the ground instead, B = 1 - A: a cap of an
// ellipsoid down to A = 1, a paraboloid, and of a hyperboloid down to A = 0, a cone. All of them
// are convex.
#pragma once

#include "terrain/rock.h"

namespace rockyard::terrain {

// What a rock's profile does not change. Lengths in m.
struct RockOutline {
  double diameter_m = 0.0;     // 2 a
  double width_ratio = 1.0;    // b / a
  double half_height_m = 0.0;  // c of the rock of pointedness 0, buried part included
  double height_m = 0.0;       // h, of the top above the ground
};

// Returns the rock at the origin, without yaw, with A = (1 - pointedness) 2 h / c. Pointedness 0 is
// the ellipsoid, 1 would be the cone. Above 0 no more than half of the outline's full height may be
// buried.
Rock ShapeRock(const RockOutline& outline, double pointedness);

}  // namespace rockyard::terrain
