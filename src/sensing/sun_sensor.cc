#include "sensing/sun_sensor.h"

#include <cmath>

#include "core/check.h"
#include "core/distributions.h"
#include "math/angles.h"

namespace rockyard::sensing {
namespace {

constexpr double kSensorHeight_m = 0.3;  // on top of the rover (Matthies 1995 sec. 2.1.2)
constexpr double kShadowReach_m = 30.0;  // a rock of 0.5 m shades it at 1 deg
constexpr double kLowestSun_rad = math::DegToRad(1.0);

}  // namespace

double SunSensor::DirectionSd_rad(double sine_of_elevation) const {
  EXPECT(sine_of_elevation > 0.0);
  return params_.noise_sd_rad *
         std::exp(0.5 * params_.optical_depth * (1.0 / sine_of_elevation - 1.0));
}

std::optional<messages::SunSighting> SunSensor::Observe(const math::Transform& X_WR,
                                                        const math::Vector3& sun_W,
                                                        const terrain::Terrain& terrain,
                                                        std::int64_t number) const {
  EXPECT(number >= 0);
  if (sun_W.z() < std::sin(kLowestSun_rad)) return std::nullopt;
  const math::Vector3 sun_R = X_WR.linear().transpose() * sun_W;
  if (sun_R.z() < std::cos(params_.half_field_of_view_rad)) return std::nullopt;
  const math::Vector3 eye_W = X_WR * math::Vector3(0.0, 0.0, kSensorHeight_m);
  if (terrain.CastRay(eye_W, sun_W, kShadowReach_m)) return std::nullopt;
  core::RandomStream stream(key_, core::Purpose::kSunSensor, static_cast<std::uint32_t>(number));
  if (core::SampleBernoulli(stream, params_.dropout_probability)) return std::nullopt;
  messages::SunSighting sighting;
  sighting.direction_sd_rad = DirectionSd_rad(sun_W.z());
  const double first = core::SampleNormal(stream, 0.0, sighting.direction_sd_rad);
  const double second = core::SampleNormal(stream, 0.0, sighting.direction_sd_rad);
  const math::Vector3 across = sun_R.unitOrthogonal();
  sighting.sun_R = (sun_R + first * across + second * sun_R.cross(across)).normalized();
  return sighting;
}

}  // namespace rockyard::sensing
