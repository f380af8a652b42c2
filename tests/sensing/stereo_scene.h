// Scenes and sensors for tests of range sensing.
#pragma once

#include <cstdint>

#include "math/pose.h"
#include "sensing/stereo_sensor.h"
#include "stripe_scene.h"

namespace rockyard::sensing {

// The error model without any error: geometry alone.
inline StereoParams NoiselessStereo() {
  return StereoParams{
      .disparity_noise_px = 0.0, .dropout_probability = 0.0, .edge_dropout_probability = 0.0};
}

inline StereoParams IdealStereo() { return StereoParams{.fidelity = StereoFidelity::kIdeal}; }

inline messages::PointCloud LookAhead(const StereoParams& params, const terrain::Terrain& terrain,
                                      const math::Transform& X_WR, std::int64_t number = 0) {
  return StereoSensor(params).Look(terrain, X_WR, {1, 0}, number, messages::LookDirection::kAhead);
}

}  // namespace rockyard::sensing
