// From motion commands to wheels: Ackermann steering of a six-wheel rover with four steered
// corners. The on-board side of every drive turns its motions into wheel commands by it. Records of
// all drives depend on its set points to the last bit, and on the ticks at which the rover stands
// to steer.
#pragma once

#include "messages/calibration.h"
#include "messages/commands.h"
#include "navigation/wheel_driver_params.h"

namespace rockyard::navigation {

// Returns the steady wheel set points of a motion: angles in rad, rates in rad/s. Every wheel rolls
// about the common centre of rotation: for an arc of curvature c that is (0, 1/c) in R, for a turn
// in place the origin. Unsteered wheels take the forward component of their velocity. The fastest
// rim moves at speed_share times max_wheel_speed_m_s. Steering angles beyond max_steer_rad are
// clamped. `calibration` is what the rover believes of its wheels, not what they are.
messages::WheelCommand SteadyWheelCommand(const messages::MotionCommand& motion,
                                          const messages::DriveCalibration& calibration);

// Drives the wheels towards a motion: when a steering angle has farther to go than
// steer_while_driving, the rover stands until all are believed to be there (the power budget allows
// one major function at a time, Matthies 1995 sec. 2.1.2). With `steers_while_rolling`
// (clock.overlap.steering) it stands so only between arcs and turns in place, whose wheels point
// elsewhere.
class WheelDriver {
 public:
  WheelDriver(const messages::DriveCalibration& calibration, const WheelDriverParams& params,
              bool steers_while_rolling = false);

  // Returns the set points for the next tick of duration_s.
  messages::WheelCommand Tick(const messages::MotionCommand& motion, double duration_s);

  // Is called when operators have put the rover down with straight wheels.
  void Straighten() { believed_steer_rad_.fill(0.0); }

  // Returns whether the rover stands to steer.
  bool steering() const { return steering_; }
  // Returns for how long of the last tick, s, the steering motors are believed to have run.
  double steered_s() const { return steered_s_; }

 private:
  // Returns SteadyWheelCommand of the motion, worked out anew only where the motion differs from
  // the last one.
  const messages::WheelCommand& Steady(const messages::MotionCommand& motion);

  messages::DriveCalibration calibration_;
  // Returns the largest change of a steering angle, rad, for which the rover does not stand.
  double AllowedChange(messages::MotionKind kind) const;

  WheelDriverParams params_;
  bool steers_while_rolling_;
  // The kind of motion for which the wheels stand, whatever the curvature; kStop: for none.
  messages::MotionKind aligned_kind_ = messages::MotionKind::kArc;
  messages::MotionCommand last_motion_;  // to which steady_ belongs
  messages::WheelCommand steady_;
  messages::PerWheel<double> believed_steer_rad_{};
  bool steering_ = false;
  double steered_s_ = 0.0;
};

}  // namespace rockyard::navigation
