#include "vision/stereo/elevation_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/check.h"

namespace rockyard::vision {
namespace {

// The share of points left out at either end, so that wrong matches do not make the grid endless.
constexpr double kLeftOut = 0.01;

// Returns the range of the coordinates along an axis, without the outermost at either end.
std::pair<double, double> MiddleRange(std::span<const Eigen::Vector3d> points,
                                      const Eigen::Vector3d& axis) {
  std::vector<double> along;
  along.reserve(points.size());
  for (const Eigen::Vector3d& point : points) along.push_back(axis.dot(point));
  const auto cut = static_cast<std::ptrdiff_t>(kLeftOut * static_cast<double>(along.size()));
  const auto low = along.begin() + cut;
  const auto high = along.end() - 1 - cut;
  std::nth_element(along.begin(), low, along.end());
  const double least = *low;
  std::nth_element(along.begin(), high, along.end());
  return {least, *high};
}

// Returns the largest multiple of `cell` up to `value`.
double Down(double value, double cell) { return std::floor(value / cell) * cell; }

int CellsOver(double from, double to, double cell) {
  return static_cast<int>(std::floor((to - from) / cell)) + 1;
}

}  // namespace

ElevationGrid GridOver(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& away,
                       const Eigen::Vector3d& up, double cell_m, int max_cells) {
  EXPECT(cell_m > 0.0 && max_cells >= 1);
  ElevationGrid grid;
  grid.away = away;
  grid.up = up;
  grid.right = away.cross(up);
  grid.cell_m = cell_m;
  if (points.empty()) return grid;
  const auto [left_m, right_m] = MiddleRange(points, grid.right);
  const auto [near_m, far_m] = MiddleRange(points, grid.away);
  // One cell less than allowed, as the first cell begins at a multiple of its size.
  const double longest_m = std::max(right_m - left_m, far_m - near_m);
  grid.cell_m = std::max(cell_m, longest_m / std::max(1, max_cells - 1));
  grid.right_from_m = Down(left_m, grid.cell_m);
  grid.away_from_m = Down(near_m, grid.cell_m);
  grid.columns = std::min(max_cells, CellsOver(grid.right_from_m, right_m, grid.cell_m));
  grid.rows = std::min(max_cells, CellsOver(grid.away_from_m, far_m, grid.cell_m));
  return grid;
}

Image<float> ElevationMap(std::span<const Eigen::Vector3d> points, const ElevationGrid& grid) {
  Image<double> sum_m(grid.columns, grid.rows);
  Image<std::int64_t> count(grid.columns, grid.rows);
  for (const Eigen::Vector3d& point : points) {
    const double column = std::floor((grid.right.dot(point) - grid.right_from_m) / grid.cell_m);
    const double ahead = std::floor((grid.away.dot(point) - grid.away_from_m) / grid.cell_m);
    if (!(column >= 0.0 && column < grid.columns && ahead >= 0.0 && ahead < grid.rows)) continue;
    const int x = static_cast<int>(column);
    const int y = grid.rows - 1 - static_cast<int>(ahead);
    sum_m.At(x, y) += grid.up.dot(point);
    ++count.At(x, y);
  }
  Image<float> mean_m(grid.columns, grid.rows, std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.columns; ++x) {
      if (count.At(x, y) == 0) continue;
      mean_m.At(x, y) = static_cast<float>(sum_m.At(x, y) / static_cast<double>(count.At(x, y)));
    }
  }
  return mean_m;
}

}  // namespace rockyard::vision
