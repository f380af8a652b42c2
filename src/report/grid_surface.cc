#include "report/grid_surface.h"

#include <algorithm>

namespace rockyard::report {

using math::Vector3;

GridSurface::GridSurface(const messages::NavigationView& view)
    : map_(view.map),
      X_RE_(math::MakePose({view.estimate.x_m, view.estimate.y_m, view.attitude.z_m},
                           view.estimate.heading_rad, view.attitude.pitch_rad,
                           view.attitude.roll_rad)
                .inverse()) {}

std::array<Vector3, 4> GridSurface::Corners(int ix, int iy) const {
  return {Corner(ix, iy), Corner(ix + 1, iy), Corner(ix + 1, iy + 1), Corner(ix, iy + 1)};
}

Vector3 GridSurface::Corner(int ix, int iy) const {
  double sum_m = 0.0;
  int cells = 0;
  for (int y = std::max(iy - 1, 0); y <= std::min(iy, map_.ny - 1); ++y) {
    for (int x = std::max(ix - 1, 0); x <= std::min(ix, map_.nx - 1); ++x) {
      const messages::MapCellView& cell = map_.Cell(x, y);
      if (!cell.has_data) continue;
      sum_m += cell.elevation_m;
      ++cells;
    }
  }
  return X_RE_ *
         Vector3(map_.x0_m + ix * map_.xstep_m, map_.y0_m + iy * map_.ystep_m, sum_m / cells);
}

}  // namespace rockyard::report
