#include "perception/cloud_elevations.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rockyard::perception {
namespace {

using math::Vector3;

// Returns the smallest height that at least the share `quantile` of the heights do not exceed: rank
// ceil(q n). It reorders the heights.
double QuantileOf(std::vector<double>& heights_m, double quantile) {
  const auto count = static_cast<double>(heights_m.size());
  const double rank = std::max(std::ceil(quantile * count) - 1.0, 0.0);
  const auto at = heights_m.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(heights_m.begin(), at, heights_m.end());
  return *at;
}

// Returns the rotation from R to what the rover takes for level; with kRover the identity.
Eigen::Matrix3d Levelling(const messages::AttitudeEstimate& attitude, ElevationFrame frame) {
  if (frame == ElevationFrame::kRover) return Eigen::Matrix3d::Identity();
  return math::MakePose(Vector3::Zero(), 0.0, attitude.pitch_rad, attitude.roll_rad).linear();
}

}  // namespace

messages::ElevationScan CloudElevations(const messages::PointCloud& cloud,
                                        const messages::AttitudeEstimate& attitude,
                                        const CloudElevationParams& params) {
  const auto rows = static_cast<std::size_t>(params.rows);
  const auto stripes = static_cast<std::size_t>(params.stripes);
  const double rows_per_m = static_cast<double>(rows) / (params.far_m - params.near_m);
  const double stripes_per_m = 0.5 * static_cast<double>(stripes) / params.half_width_m;
  const double side = cloud.direction == messages::LookDirection::kAhead ? 1.0 : -1.0;
  const Eigen::Matrix3d level = Levelling(attitude, params.frame);
  std::vector<std::vector<double>> heights_m(rows * stripes);
  for (const Vector3& p_R : cloud.points_R) {
    const Vector3 p = level * p_R;
    // Bins run from near to far and from the left to the right of whoever looks that way: looking
    // behind, both axes of R turn round.
    const double row = (side * p.x() - params.near_m) * rows_per_m;
    const double stripe = (params.half_width_m - side * p.y()) * stripes_per_m;
    // Must stay written so that a point that is not a number has no bin.
    if (!(row >= 0.0 && row < static_cast<double>(rows))) continue;
    if (!(stripe >= 0.0 && stripe < static_cast<double>(stripes))) continue;
    const std::size_t bin =
        static_cast<std::size_t>(row) * stripes + static_cast<std::size_t>(stripe);
    heights_m[bin].push_back(p.z());
  }
  messages::ElevationScan scan{cloud.number,
                               messages::StripeArray<messages::ElevationPoint>({rows, stripes})};
  for (std::size_t bin = 0; bin < heights_m.size(); ++bin) {
    // Too few points: the bin counts as a point that was not found.
    if (heights_m[bin].size() < static_cast<std::size_t>(params.min_points)) continue;
    scan.points.points()[bin] = {.detected = true,
                                 .elevation_m = QuantileOf(heights_m[bin], params.quantile)};
  }
  return scan;
}

messages::PointCloud StripeCloud(const messages::StripeScan& scan,
                                 const Triangulator& triangulator) {
  // Light stripes as a map takes them: points in R, without those that were not found.
  messages::PointCloud cloud{.number = scan.number, .points_R = {}};
  cloud.points_R.reserve(scan.pixels.points().size());
  for (std::size_t row = 0; row < scan.pixels.rows(); ++row) {
    for (std::size_t stripe = 0; stripe < scan.pixels.stripes(); ++stripe) {
      const messages::StripePixel& pixel = scan.pixels[row][stripe];
      if (!pixel.detected) continue;
      const auto point = triangulator.Point(row, stripe, pixel.column_px);
      if (point) cloud.points_R.push_back(*point);
    }
  }
  return cloud;
}

}  // namespace rockyard::perception
