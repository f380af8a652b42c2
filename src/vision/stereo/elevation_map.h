// Points seen from above: the mean height over the cells of a grid (Goldberg 2002 section 2 stage
// 7 and figure 1d). For the pictures of looks and the files of `rockyard stereo`, which people look
// at; no navigator reads it.
#pragma once

#include <Eigen/Core>
#include <span>

#include "vision/image.h"

namespace rockyard::vision {

// A grid in the plane of `right` and `away`, two directions in the points' frame, seen from above.
struct ElevationGrid {
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();  // along the columns, unit
  Eigen::Vector3d away = Eigen::Vector3d::UnitY();   // against the rows: the last row is nearest
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();     // heights count along it
  double right_from_m = 0.0;                         // left edge of column 0
  double away_from_m = 0.0;                          // near edge of the last row
  double cell_m = 0.1;                               // > 0
  int columns = 0;
  int rows = 0;
};

// Returns the grid over the middle 98 % of points in either direction, with `right` =
// `away` x `up`. The cells become larger than cell_m where there would be more than `max_cells`
// along a side. `away` and `up` are square to each other and of unit length. Without points the
// grid has no cells.
ElevationGrid GridOver(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& away,
                       const Eigen::Vector3d& up, double cell_m, int max_cells = 1000);

// Returns the mean height, m, of the points over each cell; NaN over cells without points.
Image<float> ElevationMap(std::span<const Eigen::Vector3d> points, const ElevationGrid& grid);

}  // namespace rockyard::vision
