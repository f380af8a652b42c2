// A six-wheel rover with steered corners for the tests of the wheel commands.
#pragma once

#include <algorithm>
#include <cmath>

#include "messages/calibration.h"
#include "messages/commands.h"

namespace rockyard::navigation {

inline messages::DriveCalibration SixWheels() {
  messages::DriveCalibration calibration;
  calibration.wheel_radius_m = 0.065;
  calibration.wheel_x_m = {0.22, 0.0, -0.20, 0.22, 0.0, -0.20};
  calibration.wheel_y_m = {0.19, 0.19, 0.19, -0.19, -0.19, -0.19};
  calibration.steered = {true, false, true, true, false, true};
  calibration.max_steer_rad = 1.5;
  calibration.max_wheel_speed_m_s = 0.15;
  return calibration;
}

inline messages::MotionCommand Arc(double curvature_per_m, int direction = 1) {
  return {messages::MotionKind::kArc, curvature_per_m, direction};
}

inline messages::MotionCommand TurnInPlace(int direction) {
  return {messages::MotionKind::kTurnInPlace, 0.0, direction};
}

inline double FastestRim(const messages::WheelCommand& command,
                         const messages::DriveCalibration& calibration) {
  double fastest_m_s = 0.0;
  for (const double rate_rad_s : command.rate_rad_s) {
    fastest_m_s = std::max(fastest_m_s, std::abs(rate_rad_s) * calibration.wheel_radius_m);
  }
  return fastest_m_s;
}

}  // namespace rockyard::navigation
