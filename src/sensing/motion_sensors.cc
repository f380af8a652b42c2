#include "sensing/motion_sensors.h"

#include <utility>

namespace rockyard::sensing {

MotionSensors::MotionSensors(const GyroParams& gyro, const EncoderParams& encoders,
                             double wheel_radius_m, core::TrialKey key,
                             const truth::RoverState& state)
    : gyro_(gyro, key),
      encoders_(encoders, wheel_radius_m, key),
      scrapes_(gyro.scrape, key),
      X_WR_(state.X_WR),
      wheel_angle_rad_(state.wheel_angle_rad) {}

void MotionSensors::Observe(const truth::RoverState& state, double time_s) {
  // Scrapes happen between ticks; the gyro reports them with the next one.
  pending_jump_rad_ += scrapes_.Observe(state, time_s);
}

messages::MotionMeasurement MotionSensors::Measure(const truth::RoverState& state,
                                                   double duration_s, bool moving) {
  messages::PerWheel<double> wheel_turn_rad{};
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    wheel_turn_rad[wheel] = state.wheel_angle_rad[wheel] - wheel_angle_rad_[wheel];
  }
  messages::MotionMeasurement motion;
  motion.duration_s = duration_s;
  motion.wheel_turn_rad = encoders_.Measure(wheel_turn_rad);
  motion.steer_rad = state.steer_rad;
  // Scrapes since the last tick add their jumps once.
  motion.turn_rad = gyro_.Measure(TurnAboutOwnAxis(X_WR_, state.X_WR), duration_s, moving, tick_) +
                    std::exchange(pending_jump_rad_, 0.0);
  ++tick_;
  Restart(state);
  return motion;
}

void MotionSensors::Restart(const truth::RoverState& state) {
  X_WR_ = state.X_WR;
  wheel_angle_rad_ = state.wheel_angle_rad;
}

}  // namespace rockyard::sensing
