#include "perception/stuck_detector.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::perception {
namespace {

// Commanded turn rates below this are straight driving with rounding, rad/s.
constexpr double kStraight_rad_s = 1e-3;

}  // namespace

double ToldTurnRate(const messages::WheelCommand& command,
                    const messages::DriveCalibration& calibration) {
  double mean_y_m = 0.0;
  for (const double y_m : calibration.wheel_y_m) mean_y_m += y_m / messages::kWheelCount;
  double over = 0.0;
  double under = 0.0;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    const double radius_m = calibration.wheel_radius_m * calibration.radius_ratio[i];
    const double forward_m_s = command.rate_rad_s[i] * radius_m * math::Cos(command.steer_rad[i]);
    const double aside_m = calibration.wheel_y_m[i] - mean_y_m;
    over -= aside_m * forward_m_s;
    under += aside_m * aside_m;
  }
  EXPECT(under > 0.0);
  return over / under;
}

std::optional<StuckSign> StuckDetector::Observe(const messages::WheelCommand& command,
                                                const messages::MotionMeasurement& motion,
                                                const messages::VehicleState& felt) {
  const bool moves = std::any_of(command.rate_rad_s.begin(), command.rate_rad_s.end(),
                                 [](double rate_rad_s) { return rate_rad_s != 0.0; });
  if (!moves) return std::nullopt;
  const double told_rad = ToldTurnRate(command, calibration_) * motion.duration_s;
  window_.duration_s += motion.duration_s;
  window_.told_rad += std::abs(told_rad);
  // While the rover is told to go straight, no turn counts as obeyed.
  if (std::abs(told_rad) > kStraight_rad_s * motion.duration_s) {
    window_.obeyed_rad += std::copysign(1.0, told_rad) * motion.turn_rad;
  }
  for (std::size_t i = 0; felt.motor_current_A && i < messages::kWheelCount; ++i) {
    if ((*felt.motor_current_A)[i] < params_.strain_current_A) continue;
    window_.strained_s[i] += motion.duration_s;
  }
  if (window_.duration_s < params_.window_s) return std::nullopt;
  const Window window = window_;
  Restart();
  return SignOf(window);
}

std::optional<StuckSign> StuckDetector::SignOf(const Window& window) const {
  if (window.told_rad >= params_.min_told_turn_rad &&
      window.obeyed_rad < params_.min_turn_share * window.told_rad) {
    return StuckSign::kNoTurn;
  }
  const auto strained = std::count_if(
      window.strained_s.begin(), window.strained_s.end(),
      [&](double strained_s) { return strained_s >= params_.strain_share * window.duration_s; });
  if (strained >= params_.strained_wheels) return StuckSign::kStrain;
  return std::nullopt;
}

}  // namespace rockyard::perception
