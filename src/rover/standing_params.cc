#include "rover/standing_params.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "messages/wheels.h"
#include "rover/mass_properties_params.h"
#include "rover/rover_layout_params.h"
#include "rover/wheel_rut_params.h"

namespace rockyard::rover {

messages::PerWheel<double> StaticWheelLoads(const RoverParams& params) {
  const double g = params.physics.gravity_m_s2;
  const RoverMasses masses = MakeRoverMasses(params);
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  // All x are in frame R, for the left side; the right side carries the same.
  const std::size_t on_rocker = geometry.on_bogie[0] ? 2 : 0;  // of the left wheels
  const std::size_t bogie_end = 2 - on_rocker;
  const double rocker_wheel_x = geometry.wheel_R[on_rocker].x();
  const double bogie_x = geometry.bogie_pivot_R[0].x();

  // Free body of one side's rocker with its wheel, held up by the bogie pivot at x_b and by the
  // ground under the rocker's wheel at x_r. The differential passes half of the chassis' weight and
  // of its moment on to each side, so moments about the bogie pivot give
  //   N_r (x_r - x_b) = sum_i W_i (x_i - x_b),   i = half chassis, rocker, wheel.
  const double half_chassis_N = 0.5 * masses.chassis.mass_kg * g;
  const double rocker_N = masses.rocker.mass_kg * g;
  const double wheel_N = masses.wheel.mass_kg * g;
  const double carried_N = half_chassis_N + rocker_N + wheel_N;
  const double moment_Nm = half_chassis_N * (masses.chassis.com_B.x() - bogie_x) +
                           rocker_N * (geometry.rocker_pivot_R[0].x() - bogie_x) +
                           wheel_N * (rocker_wheel_x - bogie_x);
  const double rocker_wheel_N = moment_Nm / (rocker_wheel_x - bogie_x);
  // The pivot carries the rest; with the bogie's own weight, which acts at the pivot, the lever
  // between middle and end wheel divides it:
  //   N_m - W_wheel = B (x_b - x_e) / (x_m - x_e),   N_e - W_wheel = B - (N_m - W_wheel).
  const double bogie_N = carried_N - rocker_wheel_N + masses.bogie.mass_kg * g;
  const double middle_x = geometry.wheel_R[1].x();
  const double end_x = geometry.wheel_R[bogie_end].x();
  const double middle_share = (bogie_x - end_x) / (middle_x - end_x);

  messages::PerWheel<double> load_N{};
  // Wheels of the left side begin at 0, those of the right at 3.
  for (const std::size_t side : {0, 3}) {
    load_N[side + on_rocker] = rocker_wheel_N;
    load_N[side + 1] = middle_share * bogie_N + wheel_N;
    load_N[side + bogie_end] = (1.0 - middle_share) * bogie_N + wheel_N;
  }
  return load_N;
}

// Loads are linear in the position, so that each wheel's is zero at x = N(0) / (N(0) - N(1 m)).
ComRange StandingComRange(const RoverParams& params) {
  const auto loads_at = [&params](double com_x_m) {
    RoverParams moved = params;
    moved.mass.chassis_com_x_m = com_x_m;
    return StaticWheelLoads(moved);
  };
  const messages::PerWheel<double> at_origin_N = loads_at(0.0);
  const messages::PerWheel<double> at_metre_N = loads_at(1.0);
  constexpr double kFar_m = std::numeric_limits<double>::infinity();
  ComRange range{-kFar_m, kFar_m};
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double gain_N = at_metre_N[i] - at_origin_N[i];
    const double zero_m = -at_origin_N[i] / gain_N;
    if (gain_N > 0.0) range.min_m = std::max(range.min_m, zero_m);
    if (gain_N < 0.0) range.max_m = std::min(range.max_m, zero_m);
  }
  return range;
}

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
