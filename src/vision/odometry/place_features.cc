#include "vision/odometry/place_features.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "vision/odometry/row_difference.h"

namespace rockyard::vision {

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
  if (at == 0 || at == last - first) return std::nullopt;
  // As good as the best, within the ambiguity: of all but the best and its neighbours, none.
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
  // The right eye's window is compared with the left one's about the very place, so that an error
  // of the place moves both and leaves the disparity.
  auto measured = MeasureStereo(cameras_, left_pixel, covariance_px2, left_pixel.x() - right.column,
                                right.variance_px2);
  if (!measured) return std::nullopt;
  measured->slope = right.slope;
  measured->residual = right.residual;
  return measured;
}

}  // namespace rockyard::vision
