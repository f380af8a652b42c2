#include "vision/odometry/keep_clean.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/check.h"

namespace rockyard::vision {
namespace {

double LowerQuartile(std::vector<double> residuals) {
  constexpr double kLeast = 0.5;  // grey levels: pixels are rounded
  const auto quartile = residuals.begin() + static_cast<std::ptrdiff_t>((residuals.size() - 1) / 4);
  std::nth_element(residuals.begin(), quartile, residuals.end());
  return std::max(*quartile, kLeast);
}

// Raises each share to that of the residual in its kind's lower quartile.
void RaiseShares(const std::vector<double>& residuals, std::vector<double>& shares) {
  const double quartile = LowerQuartile(residuals);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i] = std::max(shares[i], residuals[i] / quartile);
  }
}

}  // namespace

PointsSeenTwice KeepClean(const PointsSeenTwice& points, std::span<const double> in_time,
                          const PlacementParams& params) {
  EXPECT(in_time.empty() || in_time.size() == points.size());
  const auto least = static_cast<std::size_t>(params.min_kept);
  if (points.empty() || points.size() <= least) return points;
  std::vector<double> first;
  std::vector<double> second;
  for (const PointSeenTwice& point : points) {
    first.push_back(point.first.residual);
    second.push_back(point.second.residual);
  }
  std::vector<double> shares(points.size(), 0.0);
  RaiseShares(first, shares);
  RaiseShares(second, shares);
  if (!in_time.empty()) RaiseShares({in_time.begin(), in_time.end()}, shares);
  double most = params.max_residual_ratio;
  if (least > 0) {
    std::vector<double> sorted = shares;
    std::sort(sorted.begin(), sorted.end());
    most = std::max(most, sorted[least - 1]);
  }
  PointsSeenTwice clean;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (shares[i] <= most) clean.push_back(points[i]);
  }
  return clean;
}

}  // namespace rockyard::vision
