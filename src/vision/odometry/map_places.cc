#include "vision/odometry/map_places.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/check.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

// Whole disparities of the range, and one more on either side for the peak filter.
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

}  // namespace

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
      if (weight == 0.0) continue;
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

}  // namespace rockyard::vision
