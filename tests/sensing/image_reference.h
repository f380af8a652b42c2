// Plain supersampling of the light on a pixel, for comparison with the renderer: many rays, every
// shadow and every laser by a query of the whole terrain, no sharing, no closed forms.
#pragma once

#include "image_kit.h"
#include "vision/lens.h"

namespace rockyard::sensing {

struct ReferenceLight {
  double sun_e_s = 0.0;
  std::vector<double> laser_e_s;  // by laser
};

class ReferenceRenderer {
 public:
  ReferenceRenderer(const LineView& line, const terrain::Terrain& terrain,
                    const math::Transform& X_WR)
      : line_(line),
        terrain_(terrain),
        X_WR_(X_WR),
        light_(rendering::MakeSunLight(line.sun, line.params.imager.filter_width_m)),
        beam_(line.params.laser.profile, line.params.laser.beam_width_rad) {}

  // Mean over rays_across x rays_down rays within the pixel.
  ReferenceLight Pixel(int camera, int column, int row, int rays_across, int rays_down) const {
    ReferenceLight sum;
    sum.laser_e_s.resize(line_.calibration.lasers.size());
    const double gain = rendering::RelativeIllumination(line_.Camera(camera), column, row) *
                        line_.ElectronsPerRadiance() / (rays_across * rays_down);
    for (int j = 0; j < rays_down; ++j) {
      for (int i = 0; i < rays_across; ++i) {
        AddRay(camera, column + (i + 0.5) / rays_across - 0.5, row + (j + 0.5) / rays_down - 0.5,
               gain, sum);
      }
    }
    return sum;
  }

 private:
  void AddRay(int camera, double column, double row, double gain, ReferenceLight& sum) const {
    const messages::Camera& eye = line_.Camera(camera);
    const math::Vector3 eye_W = X_WR_ * eye.X_RC.translation();
    const math::Vector3 ray_R = eye.X_RC.linear() * vision::PixelRay(eye, {column, row});
    const math::Vector3 ray_W = X_WR_.linear() * ray_R;
    const auto hit = terrain_.CastRay(eye_W, ray_W, 100.0);
    if (!hit) {
      sum.sun_e_s += gain * light_.sky_w_m2 * std::numbers::inv_pi;
      return;
    }
    const bool is_ground = hit->surface == terrain::Surface::kGround;
    const double albedo = is_ground ? line_.sun.ground_albedo : line_.sun.rock_albedo;
    const math::Vector3 above_W = hit->point_W + 1e-6 * hit->normal_W;
    const math::Transform X_RW = X_WR_.inverse();
    const math::Vector3 sun_R = X_RW.linear() * light_.toward_sun_W;
    const bool sunlit = hit->normal_W.dot(light_.toward_sun_W) > 0.0 &&
                        !terrain_.CastRay(above_W, light_.toward_sun_W, 50.0) &&
                        line_.body.Distance(X_RW * above_W, sun_R) == rendering::RoverBody::kFree;
    sum.sun_e_s += gain * rendering::SunRadiance(light_, albedo, hit->normal_W, sunlit);
    for (std::size_t i = 0; i < line_.calibration.lasers.size(); ++i) {
      sum.laser_e_s[i] += gain * albedo * std::numbers::inv_pi * Irradiance(i, *hit);
    }
  }

  double Irradiance(std::size_t laser, const terrain::RayHit& hit) const {
    const messages::StripeLaser& fan = line_.calibration.lasers[laser];
    const math::Vector3 emitter_W = X_WR_ * fan.p_RoE_R;
    const math::Vector3 away_W = hit.point_W - emitter_W;
    const math::Vector3 away_R = X_WR_.linear().transpose() * away_W;
    const double range = away_W.norm();
    const double cosine = -away_W.dot(hit.normal_W) / range;
    if (cosine <= 0.0 || terrain_.Occluded(emitter_W, hit.point_W, 5e-4)) return 0.0;
    if (fan.axis_R.dot(away_R) < std::cos(fan.half_fan_rad) * range) return 0.0;
    const double angle = std::asin(fan.normal_R.dot(away_R) / range);
    return FanPower(line_.params) * beam_.Density(angle) * cosine / (range * range);
  }

  const LineView& line_;
  const terrain::Terrain& terrain_;
  math::Transform X_WR_;
  rendering::SunLight light_;
  BeamCrossSection beam_;
};

}  // namespace rockyard::sensing
