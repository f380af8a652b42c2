#include "navigation/gestalt/patch.h"

#include <cmath>
#include <cstddef>

namespace rockyard::navigation {
namespace {

// A cell whose mean is no farther from a plane is no outlier: the resolution of coordinates.
constexpr double kInPlane_m = 1e-6;

struct Farthest {
  std::size_t index = 0;
  double distance_m = -1.0;
};

Farthest FarthestFrom(const math::Vector3& normal, const math::Vector3& mean_m,
                      const std::vector<PatchCell>& cells) {
  Farthest farthest;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    // |n . (mean of the cell - mean of the patch)|: the plane passes through the patch's mean.
    const double distance_m = std::abs(normal.dot(cells[i].spread->mean_m - mean_m));
    if (distance_m > farthest.distance_m) farthest = {i, distance_m};
  }
  return farthest;
}

}  // namespace

math::PointSpread SpreadOf(const std::vector<PatchCell>& cells, const math::PointMoments& sum) {
  // Exact sums where they cannot have run over, else cell by cell in floating point.
  if (sum.count() <= math::kExactPoints) return math::Spread(sum);
  std::vector<math::PointSpread> spreads;
  spreads.reserve(cells.size());
  for (const PatchCell& cell : cells) spreads.push_back(*cell.spread);
  return math::Merged(spreads);
}

math::PlaneFit FitWithoutOutliers(std::vector<PatchCell> cells, math::PointMoments sum,
                                  std::int64_t outliers) {
  for (std::int64_t left_out = 0;; ++left_out) {
    const math::PointSpread spread = SpreadOf(cells, sum);
    math::PlaneFit fit = math::FitPlane(spread.covariance_m2);
    if (left_out == outliers) return fit;
    // The last cell lies in its own plane.
    const Farthest worst = FarthestFrom(fit.normal, spread.mean_m, cells);
    // Leaving it out would change nothing but the number of points.
    if (worst.distance_m < kInPlane_m) return fit;
    // Whole numbers: taking a cell back is exact.
    sum -= *cells[worst.index].moments;
    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(worst.index));
  }
}

}  // namespace rockyard::navigation
