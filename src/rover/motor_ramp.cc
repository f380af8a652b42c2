#include "rover/motor_ramp.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {

MotorRamp::MotorRamp(const RoverParams& params)
    : acceleration_rad_s2_(params.drive.speed_m_s /
                           (params.geometry.wheel_radius_m * params.drive.ramp_s)) {}

MotorRates MotorRamp::Advance(const messages::PerWheel<double>& commanded_rad_s, double step_s) {
  double farthest_rad_s = 0.0;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    farthest_rad_s = std::max(farthest_rad_s, std::abs(commanded_rad_s[i] - rate_rad_s_[i]));
  }
  const double most_rad_s = acceleration_rad_s2_ * step_s;
  const bool arrives = farthest_rad_s <= most_rad_s;
  // `made`: the share of the change to the command that this step makes. `taken`: the share of the
  // step that the ramp takes.
  const double made = arrives ? 1.0 : most_rad_s / farthest_rad_s;
  const double taken = arrives ? farthest_rad_s / most_rad_s : 1.0;
  MotorRates rates;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double change_rad_s = made * (commanded_rad_s[i] - rate_rad_s_[i]);
    // A ramp that has ended gives the commanded rate to the last bit.
    rates.to[i] = arrives ? commanded_rad_s[i] : rate_rad_s_[i] + change_rad_s;
    rates.from[i] = rates.to[i] - taken * change_rad_s;
  }
  rate_rad_s_ = rates.to;
  return rates;
}

}  // namespace rockyard::rover
