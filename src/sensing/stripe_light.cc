#include "sensing/stripe_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sensing/stripe_view_params.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

constexpr double kScanlinesOfThinBeam = 3.0;  // Matthies 1995 sec. 6

}  // namespace

double FanPower(const LightStripeParams& params) {
  const LaserParams& laser = params.laser;
  // F: the fan, or three row pitches (Matthies 1995, section 6).
  const double lit_rad =
      laser.fan == BeamFan::kFull ? params.fan_rad : kScanlinesOfThinBeam * params.row_pitch_rad();
  return laser.input_power_w * laser.optical_efficiency / lit_rad;
}

LaserFan::LaserFan(const LightStripeParams& params, const messages::StripeCalibration& calibration,
                   const messages::StripeLaser& laser)
    : p_RoE_R_(laser.p_RoE_R), normal_R_(laser.normal_R), power_w_rad_(FanPower(params)) {
  if (params.laser.fan == BeamFan::kFull) {
    axes_R_.push_back(laser.axis_R);
    half_fan_cosine_ = std::cos(laser.half_fan_rad);
    return;
  }
  // Thin beams: one around each measured point of flat ground.
  for (const int row_px : calibration.scanline_px) {
    const auto point_R = StripePoint(calibration, laser, row_px);
    if (point_R) axes_R_.emplace_back((*point_R - p_RoE_R_).normalized());
  }
  half_fan_cosine_ = std::cos(0.5 * kScanlinesOfThinBeam * params.row_pitch_rad());
}

bool LaserFan::Lights(const Vector3& away_R) const {
  // The angle within the light plane counts; how far the direction lies off the plane is
  // OutOfPlane's.
  const Vector3 in_plane = away_R - normal_R_.dot(away_R) * normal_R_;
  const double least = half_fan_cosine_ * in_plane.norm();
  return std::any_of(axes_R_.begin(), axes_R_.end(),
                     [&](const Vector3& axis) { return axis.dot(in_plane) >= least; });
}

LitFan::LitFan(const LaserFan& fan, const rendering::ImageScene& scene, double reach_rad)
    : fan_(&fan),
      scene_(&scene),
      p_WoE_W_(scene.X_WR() * fan.p_RoE_R()),
      normal_W_(scene.X_WR().linear() * fan.normal_R()),
      offset_m_(normal_W_.dot(p_WoE_W_)),
      // sin(a) <= a, so light within the reach lies within reach * range of the plane.
      width_m_(reach_rad * scene.sight_m()) {
  scene.RocksInSheet(p_WoE_W_, normal_W_, width_m_, rocks_);
}

double LitFan::OutOfPlane(const Vector3& p_W) const {
  const Vector3 away_W = p_W - p_WoE_W_;
  // sin a = n . r / |r|.
  return std::asin(std::clamp(normal_W_.dot(away_W) / away_W.norm(), -1.0, 1.0));
}

double LitFan::Irradiance(const rendering::SurfacePoint& point) const {
  const Vector3 away_W = point.p_W - p_WoE_W_;
  const double range2_m2 = away_W.squaredNorm();
  // Incidence against the outward normal; E / f(a) = P / (F r^2) cos i.
  const double cosine = -point.normal_W.dot(away_W) / std::sqrt(range2_m2);
  if (cosine <= 0.0) return 0.0;
  if (!fan_->Lights(scene_->X_WR().linear().transpose() * away_W)) return 0.0;
  if (!scene_->Reaches(p_WoE_W_, point.p_W, rocks_)) return 0.0;
  return fan_->power_w_rad() * cosine / range2_m2;
}

void LitStripes::Add(const rendering::SurfacePoint& left, const rendering::SurfacePoint& right,
                     int pixel, double gain, rendering::RenderedRow& row) const {
  if (!left.TakesLampLight() && !right.TakesLampLight()) return;
  const double reach_rad = beam_.reach_rad();
  for (std::size_t laser = 0; laser < fans_.size(); ++laser) {
    const LitFan& fan = fans_[laser];
    if (fan.PassesBy(left.p_W, right.p_W)) continue;
    const double a_rad = fan.OutOfPlane(left.p_W);
    const double b_rad = fan.OutOfPlane(right.p_W);
    // The beam passes the pixel on one side.
    if (std::min(a_rad, b_rad) > reach_rad || std::max(a_rad, b_rad) < -reach_rad) continue;

    const bool one_surface = rendering::IsOneSurface(left, right);
    // (C(b) - C(a)) / (b - a): on one surface the angle out of the plane goes evenly from edge to
    // edge.
    const double mean = one_surface ? beam_.Mean(a_rad, b_rad) : 0.0;
    const auto radiance = [&](const rendering::SurfacePoint& point, double angle_rad) {
      const double density = one_surface ? mean : beam_.Density(angle_rad);
      if (density == 0.0 || !point.TakesLampLight()) return 0.0;
      // Lambert: L = albedo / pi E, E = P / (F r^2) f cos i.
      return point.albedo * std::numbers::inv_pi * density * fan.Irradiance(point);
    };
    const double sum = radiance(left, a_rad) + radiance(right, b_rad);
    if (sum > 0.0) row.lamps.push_back({pixel, static_cast<int>(laser), 0.5 * gain * sum});
  }
}

StripeLight::StripeLight(const LightStripeParams& params,
                         const messages::StripeCalibration& calibration)
    : beam_(params.laser.profile, params.laser.beam_width_rad) {
  for (const messages::StripeLaser& laser : calibration.lasers) {
    // All lasers are rendered at once; the read-out takes those of one group.
    fans_.emplace_back(params, calibration, laser);
  }
}

LitStripes StripeLight::Meet(const rendering::ImageScene& scene) const {
  std::vector<LitFan> fans;
  for (const LaserFan& fan : fans_) fans.emplace_back(fan, scene, beam_.reach_rad());
  return {beam_, std::move(fans)};
}

}  // namespace rockyard::sensing
