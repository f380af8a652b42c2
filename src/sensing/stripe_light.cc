#include "sensing/stripe_light.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace rockyard::sensing {

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
