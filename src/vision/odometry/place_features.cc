#include "vision/odometry/place_features.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "vision/odometry/row_difference.h"

namespace rockyard::vision {

std::optional<int> FeaturePlacer::WholeDisparity(int column, int row) const {
  const int first = std::max(static_cast<int>(std::floor(params_.min_disparity_px)),
                             column + kRowReach + 1 - (right_.width() - 1));
  const int last =
      std::min(static_cast<int>(std::ceil(params_.max_disparity_px)), column - kRowReach);
  if (last - first < 2) return std::nullopt;
  std::vector<std::uint32_t> differences(static_cast<std::size_t>(last - first) + 1);
  RowDifferences(left_, right_, column, row, first, differences);
  const auto best = std::min_element(differences.begin(), differences.end());
  const auto at = static_cast<int>(best - differences.begin());
  if (at == 0 || at == last - first) return std::nullopt;
  for (int other = 0; other <= last - first; ++other) {
    if (std::abs(other - at) <= 1) continue;
    if (params_.ambiguity * differences[static_cast<std::size_t>(other)] < *best) {
      return std::nullopt;
    }
  }
  return first + at;
}

std::optional<StereoMeasurement> FeaturePlacer::Place(const Pixel& left_pixel,
                                                      const Eigen::Matrix2d& covariance_px2) const {
  const auto column = static_cast<int>(std::lround(left_pixel.x()));
  const auto row = static_cast<int>(std::lround(left_pixel.y()));
  if (column < kRowReach || column >= left_.width() - kRowReach - 1 || row < kRowReach ||
      row >= left_.height() - kRowReach) {
    return std::nullopt;
  }
  const std::optional<int> whole = WholeDisparity(column, row);
  if (!whole) return std::nullopt;
  const WindowTemplate window(left_, left_pixel, Eigen::Matrix2d::Identity());
  const std::optional<RefinedPlace> right =
      window.Find(right_, Pixel(left_pixel.x() - *whole, left_pixel.y()),
                  {.along_row = true, .noise_px = params_.noise_px});
  if (!right) return std::nullopt;
  // The right eye's window is compared with the left one's about the very place, so that an error
  // of the place moves both and leaves the disparity.
  return MeasureStereo(cameras_, left_pixel, covariance_px2, left_pixel.x() - right->pixel.x(),
                       right->covariance_px2(0, 0));
}

}  // namespace rockyard::vision
