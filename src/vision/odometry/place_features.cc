#include "vision/odometry/place_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/check.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

// Returns the parameters of stereo, for the whole disparities of the range and one more on either
// side, which the peak filter needs.
StereoPipelineParams PipelineOf(const PlacementParams& params) {
  StereoPipelineParams pipeline;
  pipeline.dog = params.map.dog;
  pipeline.filters = params.map.filters;
  pipeline.correlator.window_side_px = params.map.window_side_px;
  const auto first = static_cast<std::int64_t>(std::floor(params.min_disparity_px)) - 1;
  const auto last = static_cast<std::int64_t>(std::ceil(params.max_disparity_px)) + 1;
  pipeline.correlator.min_disparity_px = first;
  pipeline.correlator.disparities = last - first + 1;
  return pipeline;
}

bool IsInside(const DisparityImage& map, int column, int row) {
  return column >= 0 && column < map.width() && row >= 0 && row < map.height();
}

double LowerQuartile(std::vector<double> residuals) {
  constexpr double kLeast = 0.5;  // grey levels: pixels are rounded
  const auto quartile = residuals.begin() + static_cast<std::ptrdiff_t>((residuals.size() - 1) / 4);
  std::nth_element(residuals.begin(), quartile, residuals.end());
  return std::max(*quartile, kLeast);
}

// Raises each share to at least the residual over the lower quartile of the residuals.
void RaiseShares(const std::vector<double>& residuals, std::vector<double>& shares) {
  const double quartile = LowerQuartile(residuals);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i] = std::max(shares[i], residuals[i] / quartile);
  }
}

}  // namespace

std::optional<double> FeaturePlacer::WholeColumn(const Pixel& left_pixel) const {
  const auto column = static_cast<int>(std::lround(left_pixel.x()));
  const auto row = static_cast<int>(std::lround(left_pixel.y()));
  if (column < kRowReach || column >= left_.width() - kRowReach || row < kRowReach ||
      row >= left_.height() - kRowReach) {
    return std::nullopt;
  }
  const int first = std::max(static_cast<int>(std::floor(params_.min_disparity_px)),
                             column + kRowReach - (right_.width() - 1));
  const int last =
      std::min(static_cast<int>(std::ceil(params_.max_disparity_px)), column - kRowReach);
  if (last - first < 2) return std::nullopt;
  std::vector<std::uint16_t> differences(static_cast<std::size_t>(last - first) + 1);
  RowDifferences(left_, right_, column, row, first, differences);
  const auto best = std::min_element(differences.begin(), differences.end());
  const auto at = static_cast<int>(best - differences.begin());
  // The best must not be at an end; then `best - 1` and `best + 2` below exist.
  if (at == 0 || at == last - first) return std::nullopt;
  // No disparity but the best and its neighbours may be as good, within the ambiguity.
  const double limit = *best / params_.ambiguity;
  const auto is_as_good = [limit](std::uint16_t difference) { return difference < limit; };
  if (std::any_of(differences.begin(), best - 1, is_as_good) ||
      std::any_of(best + 2, differences.end(), is_as_good)) {
    return std::nullopt;
  }
  return left_pixel.x() - (first + at);
}

std::optional<SlantedPlace> FeaturePlacer::FindOn(const DisparitySlope& slope,
                                                  const Pixel& left_pixel, double column) const {
  const WindowTemplate window(left_, left_pixel, LeftViewOf(slope), params_.side());
  const std::optional<RefinedPlace> right = window.Find(
      right_, Pixel(column, left_pixel.y()), {.along_row = true, .noise_px = params_.noise_px});
  if (!right) return std::nullopt;
  return SlantedPlace{right->pixel.x(), slope, right->covariance_px2(0, 0), right->residual};
}

std::optional<StereoMeasurement> FeaturePlacer::Place(const Pixel& left_pixel,
                                                      const Eigen::Matrix2d& covariance_px2) const {
  if (!params_.slanted) return PlaceOn(DisparitySlope::Zero(), left_pixel, covariance_px2);
  const std::optional<double> column = WholeColumn(left_pixel);
  if (!column) return std::nullopt;
  const auto right = FindSlanted(left_, right_, left_pixel, *column,
                                 {.along_row = true,
                                  .noise_px = params_.noise_px,
                                  .slope_sd = params_.slope_sd,
                                  .max_slope = params_.max_slope},
                                 params_.side());
  if (!right) return std::nullopt;
  return Measured(left_pixel, covariance_px2, *right);
}

std::optional<StereoMeasurement> FeaturePlacer::PlaceOn(
    const DisparitySlope& slope, const Pixel& left_pixel,
    const Eigen::Matrix2d& covariance_px2) const {
  const std::optional<double> column = WholeColumn(left_pixel);
  if (!column) return std::nullopt;
  const std::optional<SlantedPlace> right = FindOn(slope, left_pixel, *column);
  if (!right) return std::nullopt;
  return Measured(left_pixel, covariance_px2, *right);
}

std::optional<StereoMeasurement> FeaturePlacer::Measured(const Pixel& left_pixel,
                                                         const Eigen::Matrix2d& covariance_px2,
                                                         const SlantedPlace& right) const {
  // The right eye's window is compared with the left one about `left_pixel` itself, so that an
  // error of `left_pixel` moves both windows and leaves the disparity.
  auto measured = MeasureStereo(cameras_, left_pixel, covariance_px2, left_pixel.x() - right.column,
                                right.variance_px2);
  if (!measured) return std::nullopt;
  measured->slope = right.slope;
  measured->residual = right.residual;
  return measured;
}

DisparityImage MakePlacementMap(const GrayImage& left, const GrayImage& right,
                                const PlacementParams& params) {
  EXPECT(left.width() == right.width() && left.height() == right.height());
  return MatchStereo(left, right, PipelineOf(params));
}

std::optional<double> DisparityAt(const DisparityImage& map, const Pixel& place,
                                  double max_step_px) {
  const Pixel corner(std::floor(place.x()), std::floor(place.y()));
  const Pixel fraction = place - corner;
  double disparity_px = 0.0;
  double least_px = std::numeric_limits<double>::infinity();
  double largest_px = -least_px;
  for (const int down : {0, 1}) {
    for (const int across : {0, 1}) {
      const double weight = (across == 1 ? fraction.x() : 1.0 - fraction.x()) *
                            (down == 1 ? fraction.y() : 1.0 - fraction.y());
      if (weight == 0.0) continue;  // this neighbour need not have a disparity, nor exist
      const int column = static_cast<int>(corner.x()) + across;
      const int row = static_cast<int>(corner.y()) + down;
      if (!IsInside(map, column, row) || !IsValid(map.At(column, row))) return std::nullopt;
      const double neighbour_px = DisparityPx(map.At(column, row));
      disparity_px += weight * neighbour_px;
      least_px = std::min(least_px, neighbour_px);
      largest_px = std::max(largest_px, neighbour_px);
    }
  }
  if (largest_px - least_px > max_step_px) return std::nullopt;
  return disparity_px;
}

DisparitySlope SlopeAt(const DisparityImage& map, const Pixel& place, double max_step_px) {
  constexpr int kReach_px = 7;
  DisparitySlope slope = DisparitySlope::Zero();
  const Pixel middle(std::round(place.x()), std::round(place.y()));
  const double anything = std::numeric_limits<double>::infinity();
  for (const int axis : {0, 1}) {
    const Pixel step = kReach_px * Pixel::Unit(axis);
    const auto before = DisparityAt(map, middle - step, anything);
    const auto here = DisparityAt(map, middle, anything);
    const auto after = DisparityAt(map, middle + step, anything);
    if (!before || !here || !after) continue;
    if (std::abs(0.5 * (*before + *after) - *here) > max_step_px) continue;
    slope[axis] = (*after - *before) / (2.0 * kReach_px);
  }
  return slope;
}

std::optional<StereoMeasurement> PlaceInMap(const RectifiedPair& cameras,
                                            const PlacementParams& params,
                                            const DisparityImage& map, const Pixel& left_pixel,
                                            const Eigen::Matrix2d& covariance_px2) {
  const auto disparity_px = DisparityAt(map, left_pixel, params.map.max_step_px);
  if (!disparity_px || *disparity_px < params.min_disparity_px ||
      *disparity_px > params.max_disparity_px) {
    return std::nullopt;
  }
  auto measured = MeasureStereo(cameras, left_pixel, covariance_px2, *disparity_px,
                                params.map.noise_px * params.map.noise_px);
  if (measured) measured->slope = SlopeAt(map, left_pixel, params.map.max_step_px);
  return measured;
}

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
