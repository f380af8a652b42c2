// The one rock geometry that physics, sensors and plots share: an ellipsoid with two horizontal
// axes turned by yaw and one vertical axis, partly below the ground, or a cap that stands on it
// (ShapeRock).
#pragma once

#include <vector>

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

// Points of rocks for drawings. World frame, m.

// Returns a point of W from the coordinates of the rock in which its semi-axes are 1.
math::Vector3 OnRock(const Rock& rock, const math::Vector3& unit);

// Returns how wide the rock is at a height above its centre, both as shares of its semi-axes: 1 at
// its widest, 0 at the top, 1.
double ParallelRadius(const Rock& rock, double unit_height);

// Returns an octagon of the size of the rock seen from above, at the height of its widest part.
std::vector<math::Vector3> PlanOutline(const Rock& rock);

// Returns points spread over the surface above a ground of that height, with the top and a ring
// where the rock leaves the ground. All of what is seen of a rock lies within their convex hull,
// but for 2 % of its width. Empty where the ground covers the rock.
std::vector<math::Vector3> PointsAbove(const Rock& rock, double ground_m);

}  // namespace rockyard::terrain
