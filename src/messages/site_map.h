/// @file
/// What is known of a site before the drive: a coarse map made from orbit, with its error.
/// Scenarios ask for one (course.site_map), and navigators get it at the start.
#pragma once

#include <cstddef>
#include <vector>

namespace rockyard::messages {

/// Heights or rocks on a grid of square cells, in the world frame W as far as its maker knows:
/// estimates and told goals have errors of their own against W. Row-major, x ascending fastest.
struct SiteMap {
  double x0_m = 0.0;  ///< lower corner of the first cell
  double y0_m = 0.0;
  double step_m = 1.0;  ///< side of a cell: the resolution
  int nx = 0;           ///< cells along x
  int ny = 0;
  /// Mean height of the ground and of what stands on it, m above the datum of W; empty where the
  /// map has none.
  std::vector<double> height_m;
  double height_sd_m = 0.0;  ///< stated error of a height, one standard deviation
  /// Share of each cell that rocks large enough for it cover, 0 to 1; empty where the map has none.
  std::vector<double> rock_share;

  /// Return the place of a cell in the lists. Requires 0 <= ix < nx and 0 <= iy < ny.
  std::size_t Index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) +
           static_cast<std::size_t>(ix);
  }
};

}  // namespace rockyard::messages
