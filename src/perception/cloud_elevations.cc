#include "perception/cloud_elevations.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/plane_fit.h"
#include "math/point_moments.h"

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

// Fits of a plane at most; sets of points that it leaves out may take turns.
constexpr int kMaxFits = 10;

// The plane in which ground lies level, through its origin.
struct Ground {
  Vector3 origin = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();

  double Height_m(const Vector3& p) const { return normal.dot(p - origin); }
};

// Returns the plane of the points (total least squares), fitted anew without those that stand out
// from the last plane until no more come or go; the level where it is steeper than max_plane or
// there is none.
Ground GroundOf(const std::vector<Vector3>& points, const CloudElevationParams& params) {
  Ground ground;
  std::int64_t count = -1;
  for (int fit = 0; fit < kMaxFits; ++fit) {
    math::PointMoments moments;
    for (const Vector3& p : points) {
      if (fit > 0 && std::abs(ground.Height_m(p)) > params.plane_outlier_m) continue;
      moments.AddPoint(math::ToMomentUnits(p.x()), math::ToMomentUnits(p.y()),
                       math::ToMomentUnits(p.z()));
    }
    if (moments.count() < 3) return {};
    if (moments.count() == count) break;
    count = moments.count();
    const math::PointSpread spread = math::Spread(moments);
    ground = {spread.mean_m, math::FitPlane(spread.covariance_m2).normal};
  }
  return math::Slope_rad(ground.normal) <= params.max_plane_rad ? ground : Ground{};
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
  std::vector<std::size_t> bins;
  std::vector<Vector3> points;
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
    bins.push_back(bin);
    points.push_back(p);
  }
  const Ground ground =
      params.frame == ElevationFrame::kPlane ? GroundOf(points, params) : Ground{};
  std::vector<std::vector<double>> heights_m(rows * stripes);
  for (std::size_t i = 0; i < points.size(); ++i) {
    heights_m[bins[i]].push_back(ground.Height_m(points[i]));
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
