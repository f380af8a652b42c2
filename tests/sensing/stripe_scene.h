// Scenes for the light stripe sensor and scans without noise.
#pragma once

#include "perception/triangulation.h"
#include "sensing/light_stripe.h"
#include "terrain/placed_rocks.h"

namespace rockyard::sensing {

inline LightStripeParams NoiselessParams() {
  return LightStripeParams{.wrong_place_probability = 0.0};
}

using terrain::EllipsoidRock;
using terrain::FlatWith;

// Level ground, bare.
inline const terrain::Terrain& Flat() {
  static const terrain::Terrain flat = FlatWith({});
  return flat;
}

inline math::Transform PoseAt(double x_m, double y_m, double z_m, double heading_rad = 0.0) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.translation() = math::Vector3(x_m, y_m, z_m);
  X_WR.linear() = Eigen::AngleAxisd(heading_rad, math::Vector3::UnitZ()).toRotationMatrix();
  return X_WR;
}

inline messages::ElevationScan Elevations(const LightStripeParams& params,
                                          const terrain::Terrain& terrain,
                                          const math::Transform& X_WR) {
  const LightStripe sensor(params);
  const perception::Triangulator triangulator(sensor.calibration());
  return triangulator.Elevations(sensor.Scan(terrain, X_WR, {1, 0}, 0));
}

}  // namespace rockyard::sensing
