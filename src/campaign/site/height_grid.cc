#include "campaign/site/height_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/numbers.h"

namespace rockyard::campaign {
namespace {

using image_files::RasterWindow;

// Number of missing cells above and to the left of each corner of cells: (rows + 1) x (columns +
// 1).
class MissingTable {
 public:
  MissingTable(std::span<const double> heights, std::int64_t rows, std::int64_t columns)
      : width_(columns + 1), sums_(static_cast<std::size_t>((rows + 1) * width_)) {
    for (std::int64_t r = 0; r < rows; ++r) {
      std::int64_t in_row = 0;
      for (std::int64_t c = 0; c < columns; ++c) {
        in_row += std::isnan(heights[static_cast<std::size_t>(r * columns + c)]) ? 1 : 0;
        At(r + 1, c + 1) = At(r, c + 1) + in_row;
      }
    }
  }

  std::int64_t Missing(std::int64_t row, std::int64_t column, const RasterWindow& size) const {
    const std::int64_t below = row + size.rows;
    const std::int64_t right = column + size.columns;
    return At(below, right) - At(row, right) - At(below, column) + At(row, column);
  }

 private:
  std::int64_t& At(std::int64_t r, std::int64_t c) {
    return sums_[static_cast<std::size_t>(r * width_ + c)];
  }
  std::int64_t At(std::int64_t r, std::int64_t c) const {
    return sums_[static_cast<std::size_t>(r * width_ + c)];
  }

  std::int64_t width_;
  std::vector<std::int64_t> sums_;
};

// Returns the four weights at t in [0, 1) between the second node and the third.
std::array<double, 4> CubicWeights(double t) {
  const double s = 1.0 - t;
  return {-0.5 * t * s * s, 1.0 + t * t * (1.5 * t - 2.5), 1.0 + s * s * (1.5 * s - 2.5),
          -0.5 * s * t * t};
}

// Gives each missing cell the mean of its neighbours that have a value. Returns the cells, the
// outermost of a gap first; nothing where a gap is too wide.
std::optional<std::vector<std::size_t>> Bridge(HeightGrid& grid) {
  std::vector<std::size_t> filled;
  for (int ring = 0; ring < kWidestGap_cells / 2; ++ring) {
    std::vector<std::pair<std::size_t, double>> found;
    for (std::int64_t r = 0; r < grid.rows; ++r) {
      for (std::int64_t c = 0; c < grid.columns; ++c) {
        if (!std::isnan(grid.At(c, r))) continue;
        double sum = 0.0;
        int count = 0;
        for (const auto& [dc, dr] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (c + dc < 0 || c + dc >= grid.columns || r + dr < 0 || r + dr >= grid.rows) continue;
          const double height_m = grid.At(c + dc, r + dr);
          if (std::isnan(height_m)) continue;
          sum += height_m;
          ++count;
        }
        if (count > 0) found.emplace_back(r * grid.columns + c, sum / count);
      }
    }
    for (const auto& [at, height_m] : found) {
      grid.heights_m[at] = height_m;
      filled.push_back(at);
    }
    if (found.empty()) break;
  }
  if (CountMissing(grid.heights_m) > 0) return std::nullopt;
  return filled;
}

// Returns the largest change of a step of relaxation.
double RelaxOnce(HeightGrid& grid, const std::vector<std::size_t>& cells) {
  double largest_m = 0.0;
  for (const std::size_t at : cells) {
    const auto row = static_cast<std::int64_t>(at) / grid.columns;
    const auto column = static_cast<std::int64_t>(at) % grid.columns;
    // Beyond an edge the surface goes on level.
    const double mean_m = 0.25 * (grid.At(std::max<std::int64_t>(column - 1, 0), row) +
                                  grid.At(std::min(column + 1, grid.columns - 1), row) +
                                  grid.At(column, std::max<std::int64_t>(row - 1, 0)) +
                                  grid.At(column, std::min(row + 1, grid.rows - 1)));
    largest_m = std::max(largest_m, std::abs(mean_m - grid.heights_m[at]));
    grid.heights_m[at] = mean_m;
  }
  return largest_m;
}

}  // namespace

std::int64_t CountMissing(std::span<const double> heights) {
  return std::ranges::count_if(heights, [](double height) { return std::isnan(height); });
}

std::optional<RasterWindow> NearestClean(std::span<const double> heights,
                                         const RasterWindow& around, const RasterWindow& wanted) {
  const MissingTable table(heights, around.rows, around.columns);
  std::optional<RasterWindow> best;
  std::int64_t best_distance = 0;
  for (std::int64_t r = 0; r + wanted.rows <= around.rows; ++r) {
    for (std::int64_t c = 0; c + wanted.columns <= around.columns; ++c) {
      const std::int64_t dr = around.row + r - wanted.row;
      const std::int64_t dc = around.column + c - wanted.column;
      const std::int64_t distance = dr * dr + dc * dc;
      if (best && distance >= best_distance) continue;
      if (table.Missing(r, c, wanted) > 0) continue;
      best = RasterWindow{around.row + r, around.column + c, wanted.rows, wanted.columns};
      best_distance = distance;
    }
  }
  return best;
}

std::optional<std::int64_t> FillGaps(HeightGrid& grid) {
  const std::int64_t missing = CountMissing(grid.heights_m);
  if (static_cast<double>(missing) >
      kMostMissingShare * static_cast<double>(grid.heights_m.size())) {
    return std::nullopt;
  }
  const auto cells = Bridge(grid);
  if (!cells) return std::nullopt;
  // Gaps are at most ten cells wide: a hundred steps reduce what is wrong by far more than 1e5.
  constexpr double kStill_m = 1e-6;
  constexpr int kMostSteps = 2000;
  for (int step = 0; step < kMostSteps && RelaxOnce(grid, *cells) > kStill_m; ++step) {
  }
  return missing;
}

double CubicAt(std::span<const double> values, std::int64_t columns, double column, double row) {
  const auto rows = static_cast<std::int64_t>(values.size()) / columns;
  constexpr double kOnEdge = 1e-6;
  // Written so that what is no number fails too.
  if (!(column >= -kOnEdge && row >= -kOnEdge &&
        column <= static_cast<double>(columns - 1) + kOnEdge &&
        row <= static_cast<double>(rows - 1) + kOnEdge)) {
    return core::kNaN;
  }
  const std::array<double, 4> across = CubicWeights(column - std::floor(column));
  const std::array<double, 4> along = CubicWeights(row - std::floor(row));
  const std::int64_t first_column = static_cast<std::int64_t>(std::floor(column)) - 1;
  const std::int64_t first_row = static_cast<std::int64_t>(std::floor(row)) - 1;
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int64_t r =
        std::clamp<std::int64_t>(first_row + static_cast<std::int64_t>(i), 0, rows - 1);
    for (std::size_t j = 0; j < 4; ++j) {
      const std::int64_t c =
          std::clamp<std::int64_t>(first_column + static_cast<std::int64_t>(j), 0, columns - 1);
      sum += along[i] * across[j] * values[static_cast<std::size_t>(r * columns + c)];
    }
  }
  return sum;
}

}  // namespace rockyard::campaign
