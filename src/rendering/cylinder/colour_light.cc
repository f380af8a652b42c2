#include "rendering/cylinder/colour_light.h"

#include <algorithm>
#include <cmath>

#include "rendering/radiometry.h"

namespace rockyard::rendering {
namespace {

constexpr double kAnyWidth_m = 1e-9;  // of a passband, which the shares do not depend on

SunLight StrengthsOf(const CylinderLightParams& light) {
  SunParams sun;
  sun.elevation_rad = light.elevation_rad;
  sun.azimuth_rad = light.azimuth_rad;
  sun.irradiance_w_m2_nm = 1.0;
  sun.distance_au = 1.0;
  sun.optical_depth = light.optical_depth;
  sun.diffuse_share = light.diffuse_share;
  return MakeSunLight(sun, kAnyWidth_m);
}

}  // namespace

ColourLight::ColourLight(const CylinderLightParams& light, const Colour& ground) {
  const SunLight strengths = StrengthsOf(light);
  toward_sun_L_ = strengths.toward_sun_W;
  sun_ = strengths.direct_w_m2 * ToColour(light.sun);
  sky_ = strengths.sky_w_m2 * ToColour(light.sky);
  ground_ = ground * (sun_ * std::max(0.0, toward_sun_L_.z()) + sky_);
}

Colour ColourLight::On(const math::Vector3& normal_L) const {
  const double facing = std::max(0.0, normal_L.dot(toward_sun_L_));
  const double up = 0.5 * (1.0 + normal_L.z());
  return sun_ * facing + sky_ * up + ground_ * (1.0 - up);
}

}  // namespace rockyard::rendering
