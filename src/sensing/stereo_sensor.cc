#include "sensing/stereo_sensor.h"

#include <cmath>
#include <utility>
#include <vector>

#include "sensing/stereo_depth.h"

namespace rockyard::sensing {

using math::Vector3;
using messages::LookDirection;

StereoSensor::StereoSensor(const StereoParams& params)
    : params_(params),
      matcher_(params),
      ahead_R_(MakeStereoView(params, LookDirection::kAhead)),
      behind_R_(MakeStereoView(params, LookDirection::kBehind)) {}

std::vector<double> StereoSensor::MatchedDepths(core::TrialKey key, std::int64_t look_number,
                                                const terrain::Terrain& terrain,
                                                const StereoView& view_W) const {
  const double scale_px_m = view_W.focal_px * view_W.baseline_m;
  std::vector<double> all = InverseDepths(terrain, view_W, params_.max_range_m);
  std::vector<double> seen = all;
  HideFromRightEye(terrain, view_W, seen);
  for (double& inverse_depth : all) inverse_depth *= scale_px_m;
  for (double& inverse_depth : seen) inverse_depth *= scale_px_m;
  matcher_.Match(key, static_cast<std::uint32_t>(look_number), all, seen);
  for (double& disparity_px : seen) disparity_px /= scale_px_m;
  return seen;
}

messages::PointCloud StereoSensor::Look(const terrain::Terrain& terrain,
                                        const math::Transform& X_WR, core::TrialKey key,
                                        std::int64_t look_number, LookDirection direction) const {
  const StereoView& view_R = this->view_R(direction);
  const StereoView view_W = view_R.From(X_WR);
  const std::vector<double> depths = params_.fidelity == StereoFidelity::kIdeal
                                         ? InverseDepths(terrain, view_W, params_.max_range_m)
                                         : MatchedDepths(key, look_number, terrain, view_W);
  messages::PointCloud cloud{.number = look_number, .direction = direction, .points_R = {}};
  cloud.points_R.reserve(depths.size());
  const double* inverse_depth = depths.data();
  for (int row = 0; row < view_R.rows; ++row) {
    for (int column = 0; column < view_R.columns; ++column, ++inverse_depth) {
      if (*inverse_depth <= 0.0) continue;
      const Vector3 p_RoP_R = view_R.eye + view_R.Ray(column, row) / *inverse_depth;
      if (InWindow(p_RoP_R, direction)) cloud.points_R.push_back(p_RoP_R);
    }
  }
  return cloud;
}

bool StereoSensor::InWindow(const Vector3& p_RoP_R, LookDirection direction) const {
  if (params_.field_of_view == StereoFieldOfView::kFull) return true;
  const StripeWindowParams& window = params_.stripe_window;
  const double ahead_m = direction == LookDirection::kAhead ? p_RoP_R.x() : -p_RoP_R.x();
  return ahead_m >= window.near_m && ahead_m <= window.far_m &&
         std::abs(p_RoP_R.y()) <= window.half_width_m;
}

}  // namespace rockyard::sensing
