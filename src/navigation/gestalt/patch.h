// The plane of one patch from its cells, where the sums of PatchPlanes do not do.
#pragma once

#include <cstdint>
#include <vector>

#include "math/plane_fit.h"
#include "math/point_moments.h"

namespace rockyard::navigation {

// A cell with data.
struct PatchCell {
  const math::PointMoments* moments;
  const math::PointSpread* spread;  // of those moments
};

// Returns the spread of all points of `cells`, whose moments add up to `sum`: from the sum, which
// is exact, up to math::kExactPoints points; merged in floating point above, where it may have run
// over. Cost: O(1) or O(cells).
math::PointSpread SpreadOf(const std::vector<PatchCell>& cells, const math::PointMoments& sum);

// Leaves out up to `outliers` cells, one after the other, each time the one whose mean lies
// farthest from the plane of what is left (Goldberg 2002, section 4, step 3, names no rule). Of
// equally far ones it takes the first; none that lies within a micrometre of the plane; never the
// last cell. Cost: O(cells times outliers).
math::PlaneFit FitWithoutOutliers(std::vector<PatchCell> cells, math::PointMoments sum,
                                  std::int64_t outliers);

}  // namespace rockyard::navigation
