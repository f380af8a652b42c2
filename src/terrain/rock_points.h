// Points of rocks for drawings. World frame, m.
#pragma once

#include <vector>

#include "math/pose.h"
#include "terrain/rock.h"

namespace rockyard::terrain {

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
