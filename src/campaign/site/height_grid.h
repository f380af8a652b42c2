// Heights on a square grid of nodes, what lacks data among them, and its cure. Elevation files are
// brought to this form; scenarios of sites and tables of sites are made of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "image_files/elevation_raster.h"

namespace rockyard::campaign {

// Nodes row by row, from small y to large y, x ascending in a row. NaN: no data.
struct HeightGrid {
  double cell_m = 1.0;
  std::int64_t rows = 0;
  std::int64_t columns = 0;
  std::vector<double> heights_m;

  double At(std::int64_t column, std::int64_t row) const {
    return heights_m[static_cast<std::size_t>(row * columns + column)];
  }
  double& At(std::int64_t column, std::int64_t row) {
    return heights_m[static_cast<std::size_t>(row * columns + column)];
  }
};

// Returns how many of the heights are NaN.
std::int64_t CountMissing(std::span<const double> heights);

// Returns the window of the size of `wanted`, within `around`, that is free of NaN and whose middle
// lies nearest to that of `wanted`; nothing where there is none. `heights` are those of `around`.
// Time: the cells of `around`.
std::optional<image_files::RasterWindow> NearestClean(std::span<const double> heights,
                                                      const image_files::RasterWindow& around,
                                                      const image_files::RasterWindow& wanted);

// The widest gap that FillGaps bridges, cells, and the largest share of missing cells.
inline constexpr int kWidestGap_cells = 10;
inline constexpr double kMostMissingShare = 0.05;

// Fills NaN with the solution of Laplace's equation between the heights around them (of the four
// neighbours each is the mean, to 1e-5 m). Returns how many were filled; nothing where more than
// kMostMissingShare are missing, or a missing cell is more than half of kWidestGap_cells from data.
std::optional<std::int64_t> FillGaps(HeightGrid& grid);

// Returns the value at a place between the nodes of a window, by cubic convolution of 4 x 4 nodes
// (Keys 1981, a = -1/2): exact for quadratic surfaces. Beyond an edge the nearest node
// counts. NaN where a node is NaN, and at a place beyond the window. `column` and `row` count from
// the first node of the window.
double CubicAt(std::span<const double> values, std::int64_t columns, double column, double row);

}  // namespace rockyard::campaign
