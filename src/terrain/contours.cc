#include "terrain/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "math/functions.h"

namespace rockyard::terrain {
namespace {

// Ground whose heights differ by less is level for a map.
constexpr double kLevel_m = 1e-6;

// The heights at the corners of a grid.
struct Grid {
  double x0_m, y0_m, step_x_m, step_y_m;
  std::size_t columns, rows;  // of corners
  std::vector<double> heights_m;

  double At(std::size_t column, std::size_t row) const { return heights_m[row * columns + column]; }
};

Grid Sample(const Ground& ground, const Rectangle& area, int cells) {
  const double width_m = area.x_max_m - area.x_min_m;
  const double depth_m = area.y_max_m - area.y_min_m;
  const double side_m = std::sqrt(width_m * depth_m / cells);
  Grid grid{area.x_min_m,
            area.y_min_m,
            0.0,
            0.0,
            static_cast<std::size_t>(std::ceil(width_m / side_m)) + 1,
            static_cast<std::size_t>(std::ceil(depth_m / side_m)) + 1,
            {}};
  grid.step_x_m = width_m / static_cast<double>(grid.columns - 1);
  grid.step_y_m = depth_m / static_cast<double>(grid.rows - 1);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      grid.heights_m.push_back(
          ground.Height(grid.x0_m + static_cast<double>(column) * grid.step_x_m,
                        grid.y0_m + static_cast<double>(row) * grid.step_y_m));
    }
  }
  return grid;
}

double IntervalOf(double relief_m, int most) {
  double interval_m = math::Pow(10.0, std::floor(math::Log10(relief_m / most)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (relief_m / (factor * interval_m) <= most) return factor * interval_m;
  }
  return 10.0 * interval_m;
}

// The contours of one height. An edge of the grid has the number of its left or lower corner, times
// two, and one more where it goes up; a contour crosses each edge once at most.
class OneHeight {
 public:
  OneHeight(const Grid& grid, double height_m)
      : grid_(grid), height_m_(height_m), ends_(2 * grid.heights_m.size(), {kNone, kNone}) {
    for (std::size_t row = 0; row + 1 < grid.rows; ++row) {
      for (std::size_t column = 0; column + 1 < grid.columns; ++column) AddCell(column, row);
    }
  }

  // Appends the lines: first those that begin at the edge of the area, then the closed ones.
  void Trace(std::vector<Contour>& out) {
    for (const bool closed : {false, true}) {
      for (std::size_t edge = 0; edge < ends_.size(); ++edge) {
        const bool starts = ends_[edge][0] != kNone && (closed || ends_[edge][1] == kNone);
        if (starts) out.push_back({height_m_, Follow(edge)});
      }
    }
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  bool Above(std::size_t column, std::size_t row) const {
    return grid_.At(column, row) > height_m_;
  }
  void Join(std::size_t a, std::size_t b) {
    ends_[a][ends_[a][0] == kNone ? 0 : 1] = b;
    ends_[b][ends_[b][0] == kNone ? 0 : 1] = a;
  }
  void AddCell(std::size_t column, std::size_t row) {
    const bool low_left = Above(column, row), low_right = Above(column + 1, row);
    const bool high_left = Above(column, row + 1), high_right = Above(column + 1, row + 1);
    const std::size_t corner = row * grid_.columns + column;
    const std::size_t low = 2 * corner, left = low + 1;
    const std::size_t right = left + 2, high = low + 2 * grid_.columns;
    std::array<std::size_t, 4> crossed{};
    std::size_t count = 0;
    if (low_left != low_right) crossed[count++] = low;
    if (low_right != high_right) crossed[count++] = right;
    if (high_left != high_right) crossed[count++] = high;
    if (low_left != high_left) crossed[count++] = left;
    if (count == 2) Join(crossed[0], crossed[1]);
    if (count != 4) return;
    // A saddle: the mean of the corners tells which two of them are joined.
    const double mean_m = 0.25 * (grid_.At(column, row) + grid_.At(column + 1, row) +
                                  grid_.At(column, row + 1) + grid_.At(column + 1, row + 1));
    if ((mean_m > height_m_) == low_left) {
      Join(low, right);
      Join(high, left);
    } else {
      Join(low, left);
      Join(right, high);
    }
  }

  CoursePoint PointOn(std::size_t edge) const {
    const std::size_t corner = edge / 2;
    const std::size_t column = corner % grid_.columns, row = corner / grid_.columns;
    const bool up = edge % 2 == 1;
    const double from_m = grid_.At(column, row);
    const double to_m = up ? grid_.At(column, row + 1) : grid_.At(column + 1, row);
    const double share = (height_m_ - from_m) / (to_m - from_m);
    return {grid_.x0_m + (static_cast<double>(column) + (up ? 0.0 : share)) * grid_.step_x_m,
            grid_.y0_m + (static_cast<double>(row) + (up ? share : 0.0)) * grid_.step_y_m};
  }

  // Follows the contour from an edge on, and takes it away.
  std::vector<CoursePoint> Follow(std::size_t edge) {
    std::vector<CoursePoint> line{PointOn(edge)};
    std::size_t before = kNone;
    while (edge != kNone) {
      const auto [a, b] = std::exchange(ends_[edge], {kNone, kNone});
      const std::size_t next = a == before ? b : a;
      before = edge;
      edge = next;
      if (edge != kNone) line.push_back(PointOn(edge));
    }
    return line;
  }

  const Grid& grid_;
  double height_m_;
  std::vector<std::array<std::size_t, 2>> ends_;  // the edges that a contour goes on to
};

}  // namespace

ContourMap Contours(const Ground& ground, const Rectangle& area, int most, int cells) {
  const Grid grid = Sample(ground, area, cells);
  const auto [lowest, highest] = std::minmax_element(grid.heights_m.begin(), grid.heights_m.end());
  ContourMap map;
  if (*highest - *lowest < kLevel_m) return map;
  map.interval_m = IntervalOf(*highest - *lowest, most);
  for (double k = std::ceil(*lowest / map.interval_m); k * map.interval_m < *highest; ++k) {
    OneHeight(grid, k * map.interval_m).Trace(map.lines);
  }
  return map;
}

}  // namespace rockyard::terrain
