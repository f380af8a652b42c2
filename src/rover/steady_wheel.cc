#include "rover/steady_wheel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "math/functions.h"
#include "rover/wheel_soil.h"

namespace rockyard::rover {

SteadyForces SteadyWheel(const WheelOnSoil& soil, double radius_m, double load_N, double slip,
                         double slip_angle_rad) {
  if (!(load_N > 0.0 && std::isfinite(load_N))) {
    throw core::UserError("load_N", "is not above 0", "use newtons");
  }
  if (!(std::abs(slip) < 1.0)) {
    throw core::UserError("slip", "is not between -1 and 1",
                          "use (rim - travel) / max(rim, travel) of the speeds");
  }
  if (!(std::abs(slip_angle_rad) <= 0.5 * std::numbers::pi)) {
    throw core::UserError("slip_angle_rad", "is not from -pi/2 to pi/2", "use radians");
  }
  // Speed of the carriage over that of the rim.
  const double travel = slip >= 0.0 ? 1.0 - slip : 1.0 / (1.0 + slip);
  const double along = 1.0 - travel * math::Cos(slip_angle_rad);
  const double across = travel * math::Sin(slip_angle_rad);
  const double slides = math::Hypot(along, across);
  const SoilAnswer answer = soil.Under(load_N, std::min(slides, 1.0));
  SteadyForces forces{.sinkage_m = answer.sinkage_m, .resistance_N = answer.resistance_N};
  forces.pull_N = -answer.resistance_N;
  if (slides == 0.0) return forces;
  const double share =
      std::isinf(answer.shear_ratio) ? 1.0 : ShareOfRatio(answer.shear_ratio * slides).value;
  const double traction_N = answer.traction_N * share;
  const double gross_N = traction_N * along / slides;
  forces.pull_N += gross_N;
  forces.torque_Nm = radius_m * gross_N;
  forces.side_N = traction_N * across / slides;
  if (across != 0.0) forces.side_N += std::copysign(answer.side_N, across);
  return forces;
}

}  // namespace rockyard::rover
