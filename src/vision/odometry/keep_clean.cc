#include "vision/odometry/keep_clean.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace rockyard::vision {

double ResidualLimit(std::span<const double> residuals, const PlacementParams& params) {
  const auto least = static_cast<std::size_t>(params.min_kept);
  if (residuals.size() <= least) return std::numeric_limits<double>::infinity();
  std::vector<double> sorted(residuals.begin(), residuals.end());
  std::sort(sorted.begin(), sorted.end());
  const double limit = params.max_residual_ratio * sorted[(sorted.size() - 1) / 4];
  return least == 0 ? limit : std::max(limit, sorted[least - 1]);
}

}  // namespace rockyard::vision
