#include "sensing/stereo_sensor.h"

#include "sensing/stereo_window.h"

namespace rockyard::sensing {

using math::Vector3;
using messages::LookDirection;

StereoSensor::StereoSensor(const StereoParams& params)
    : params_(params),
      matcher_(params),
      ahead_R_(MakeStereoView(params, LookDirection::kAhead)),
      behind_R_(MakeStereoView(params, LookDirection::kBehind)) {}

StereoSensor::StereoSensor(const StereoParams& params, const SunShade& shade)
    : StereoSensor(params) {
  if (params.shadow_dropout_probability > 0.0) shade_ = shade;
}

PixelFlags StereoSensor::Shaded(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                const StereoView& view_W, const DepthImage& seen) const {
  PixelFlags shaded = PixelFlags::Constant(seen.rows(), seen.cols(), false);
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      if (seen(row, column) <= 0.0) continue;
      const Vector3 ray_W = view_W.Ray(column, row).normalized();
      const auto hit = terrain.CastRay(view_W.eye, ray_W, params_.max_range_m);
      shaded(row, column) = hit && shade_->IsShaded(terrain, X_WR, *hit);
    }
  }
  return shaded;
}

DepthImage StereoSensor::InverseDepths(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                       core::TrialKey key, std::int64_t look_number,
                                       LookDirection direction) const {
  const StereoView view_W = view_R(direction).From(X_WR);
  const StereoScene scene(terrain, view_W, params_.max_range_m);
  DepthImage all = scene.InverseDepths();
  // The ideal sensor stops here: one eye, no matching.
  if (params_.fidelity == StereoFidelity::kIdeal) return all;
  DepthImage seen = all;
  scene.HideFromRightEye(seen);
  const double scale_px_m = params_.focal_columns_px() * params_.baseline_m;
  // Goldberg 2002, section 2: d = f b / Z. Noise acts on the disparity; back to depth on the same
  // ray.
  all *= scale_px_m;
  seen *= scale_px_m;
  const PixelFlags shaded = shade_ ? Shaded(terrain, X_WR, view_W, seen) : PixelFlags();
  matcher_.Match(key, static_cast<std::uint32_t>(look_number), all, seen, shaded);
  seen /= scale_px_m;
  return seen;
}

messages::PointCloud StereoSensor::PointsOf(const DepthImage& inverse_depths,
                                            std::int64_t look_number,
                                            LookDirection direction) const {
  const StereoView& view_R = this->view_R(direction);
  messages::PointCloud cloud{.number = look_number, .direction = direction, .points_R = {}};
  cloud.points_R.reserve(static_cast<std::size_t>(inverse_depths.size()));
  for (int row = 0; row < view_R.rows; ++row) {
    for (int column = 0; column < view_R.columns; ++column) {
      const double inverse_depth = inverse_depths(row, column);
      if (inverse_depth <= 0.0) continue;
      // Pixel (c, r) at depth Z: eye + Z e(c, r), in R.
      const Vector3 p_RoP_R = view_R.eye + view_R.Ray(column, row) / inverse_depth;
      if (IsWanted(params_, p_RoP_R, direction)) cloud.points_R.push_back(p_RoP_R);
    }
  }
  return cloud;
}

messages::PointCloud StereoSensor::Look(const terrain::Terrain& terrain,
                                        const math::Transform& X_WR, core::TrialKey key,
                                        std::int64_t look_number, LookDirection direction) const {
  return PointsOf(InverseDepths(terrain, X_WR, key, look_number, direction), look_number,
                  direction);
}

}  // namespace rockyard::sensing
