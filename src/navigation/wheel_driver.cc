#include "navigation/wheel_driver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::navigation {
namespace {

using messages::DriveCalibration;
using messages::kWheelCount;
using messages::MotionCommand;
using messages::MotionKind;
using messages::WheelCommand;

// The velocity of a point of the rover, up to a common scale.
struct PlanarVelocity {
  double x;
  double y;
};

// Returns the velocity of the wheel's centre r = (x, y) in R, v = v_R + Omega x r, up to a common
// scale. An arc has v_R = (1, 0) and Omega = c, which gives (1 - c y, c x); a turn in place has
// Omega = 1 alone, which gives (-y, x).
PlanarVelocity WheelVelocity(const MotionCommand& motion, double wheel_x_m, double wheel_y_m) {
  if (motion.kind == MotionKind::kTurnInPlace) {
    return {-wheel_y_m * motion.direction, wheel_x_m * motion.direction};
  }
  const double c = motion.curvature_per_m;
  return {(1.0 - c * wheel_y_m) * motion.direction, c * wheel_x_m * motion.direction};
}

double Clamp(double value, double limit) { return std::clamp(value, -limit, limit); }

// Returns the steering angle in [-pi/2, pi/2] along which the wheel can roll, forward or backward.
double SteeringAngle(const PlanarVelocity& velocity) {
  const double angle = math::Atan2(velocity.y, velocity.x);
  if (angle > std::numbers::pi / 2) return angle - std::numbers::pi;
  if (angle < -std::numbers::pi / 2) return angle + std::numbers::pi;
  return angle;
}

// Returns whether two motions have the same set points. Must compare all that SteadyWheelCommand
// reads of a motion.
bool Same(const MotionCommand& a, const MotionCommand& b) {
  return a.kind == b.kind && a.curvature_per_m == b.curvature_per_m && a.direction == b.direction &&
         a.speed_share == b.speed_share;
}

}  // namespace

WheelCommand SteadyWheelCommand(const MotionCommand& motion, const DriveCalibration& calibration) {
  WheelCommand command;
  if (motion.kind == MotionKind::kStop) return command;
  messages::PerWheel<double> rim{};
  double fastest = 0.0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const PlanarVelocity v =
        WheelVelocity(motion, calibration.wheel_x_m[i], calibration.wheel_y_m[i]);
    double steer = 0.0;
    if (calibration.steered[i]) steer = Clamp(SteeringAngle(v), calibration.max_steer_rad);
    command.steer_rad[i] = steer;
    // The part of the velocity along the wheel; the part across is scrubbed.
    rim[i] = v.x * math::Cos(steer) + v.y * math::Sin(steer);
    fastest = std::max(fastest, std::abs(rim[i]));
  }
  EXPECT(fastest > 0.0);
  // rad/s per unit of rim: the fastest rim moves at its share of max_wheel_speed_m_s.
  const double scale =
      motion.speed_share * calibration.max_wheel_speed_m_s / (fastest * calibration.wheel_radius_m);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    command.rate_rad_s[i] = rim[i] * scale / calibration.radius_ratio[i];
  }
  return command;
}

WheelDriver::WheelDriver(const DriveCalibration& calibration, const WheelDriverParams& params,
                         bool steers_while_rolling)
    : calibration_(calibration),
      params_(params),
      steers_while_rolling_(steers_while_rolling),
      steady_(SteadyWheelCommand(last_motion_, calibration)) {}

const WheelCommand& WheelDriver::Steady(const MotionCommand& motion) {
  // Set points change only with the motion.
  if (!Same(motion, last_motion_)) {
    last_motion_ = motion;
    steady_ = SteadyWheelCommand(motion, calibration_);
  }
  return steady_;
}

double WheelDriver::AllowedChange(MotionKind kind) const {
  // Once standing to steer, stand until the angles have arrived.
  if (steering_) return 0.0;
  if (steers_while_rolling_ && kind == aligned_kind_)
    return std::numeric_limits<double>::infinity();
  return params_.steer_while_driving_rad;
}

WheelCommand WheelDriver::Tick(const MotionCommand& motion, double duration_s) {
  EXPECT(duration_s > 0.0);
  WheelCommand command = Steady(motion);
  // A rover at rest keeps its steering angles where they are.
  if (motion.kind == MotionKind::kStop) command.steer_rad = believed_steer_rad_;
  double largest_change = 0.0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const double change = command.steer_rad[i] - believed_steer_rad_[i];
    largest_change = std::max(largest_change, std::abs(change));
    // The driver has no steering sensor: it follows the rate limit that it knows.
    believed_steer_rad_[i] += Clamp(change, params_.steer_rate_rad_s * duration_s);
  }
  steered_s_ = std::min(largest_change / params_.steer_rate_rad_s, duration_s);
  const bool moves = motion.kind != MotionKind::kStop;
  steering_ = moves && largest_change > AllowedChange(motion.kind);
  // Wheels that are on their way from one kind to the other point to neither.
  if (moves) aligned_kind_ = steering_ ? MotionKind::kStop : motion.kind;
  if (steering_) command.rate_rad_s.fill(0.0);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    // The wheel stands the offset away from the angle that the rover believes in.
    if (calibration_.steered[i]) command.steer_rad[i] += calibration_.steering_offset_rad;
  }
  // Along a clothoid the next tick has other set points, which a rover model with long steps needs
  // to know.
  if (motion.curvature_rate_per_m2 != 0.0) command.held_s = duration_s;
  return command;
}

}  // namespace rockyard::navigation
