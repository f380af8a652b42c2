// The direction to the sun as a sensor on the rover measures it (Matthies 1995, sections 5 and 8).
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "messages/aids.h"
#include "sensing/aid_params.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// The measured direction is the true one, turned about each of two axes across it by N(0, sd(e))
// with sd(e) = sd exp(depth (1 / sin(e) - 1) / 2) for a sun at elevation e: the noise of counted
// photons, of which exp(-depth / sin e) come through the dust. Limits: the sensor stands as the
// rover does; no bias, no distortion at the edge of its view; the sky's own light is left out.
class SunSensor {
 public:
  SunSensor(const SunSensorParams& params, core::TrialKey key) : params_(params), key_(key) {}

  // `sun_W`: unit vector to the true sun. Nothing where the sun is out of view, not 1 deg above the
  // horizon, hidden by terrain, or dropped out. `number` counts measurements from 0 (stream
  // kSunSensor, substream number).
  std::optional<messages::SunSighting> Observe(const math::Transform& X_WR,
                                               const math::Vector3& sun_W,
                                               const terrain::Terrain& terrain,
                                               std::int64_t number) const;

  // sd(e), rad, of a sun whose sine of elevation is above 0.
  double DirectionSd_rad(double sine_of_elevation) const;

 private:
  SunSensorParams params_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing
