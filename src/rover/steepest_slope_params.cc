#include "rover/steepest_slope_params.h"

#include <cmath>
#include <numbers>

#include "messages/wheels.h"
#include "rover/wheel_rut_params.h"

namespace rockyard::rover {

double SteepestHeldSlope_rad(const RoverParams& params, const terrain::SoilParams& soil) {
  const WheelRut wheel(soil, params.geometry.wheel_radius_m, params.geometry.wheel_width_m);
  const double level_N = params.mass.total_kg * params.physics.gravity_m_s2 /
                         static_cast<double>(messages::kWheelCount);
  // The pull grows with the slope and what the soil bears shrinks with the load, so that the
  // difference has one root: halved until no number lies between.
  double held_rad = 0.0;
  double slides_rad = 0.5 * std::numbers::pi;
  for (int i = 0; i < 60; ++i) {
    const double slope_rad = 0.5 * (held_rad + slides_rad);
    const double bears_N = wheel.LargestTraction_N(level_N * std::cos(slope_rad));
    (level_N * std::sin(slope_rad) <= bears_N ? held_rad : slides_rad) = slope_rad;
  }
  return held_rad;
}

}  // namespace rockyard::rover
