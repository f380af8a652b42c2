// The map of a navigator as a surface, as its rover believes to stand before it.
#pragma once

#include <array>

#include "math/pose.h"
#include "messages/navigation_view.h"

namespace rockyard::report {

// The believed elevations of the map as quadrilaterals in R, by the pose and the attitude that the
// rover believes to have. `view` outlives it.
class GridSurface {
 public:
  explicit GridSurface(const messages::NavigationView& view);

  // Of a cell that holds points: once around it, each corner as high as the cells with points that
  // meet there, on average.
  std::array<math::Vector3, 4> Corners(int ix, int iy) const;

 private:
  // At the lower corner of cell (ix, iy).
  math::Vector3 Corner(int ix, int iy) const;

  const messages::MapView& map_;
  math::Transform X_RE_;  // of the map's frame
};

}  // namespace rockyard::report
