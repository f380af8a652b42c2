// How the rover drifts sideways as it drives: what its estimator tells of its motion beyond what
// wheels and gyro say, as visual odometry does where wheels slip down a slope. The cycle aims off
// by it (remedies.against_drift).
#pragma once

#include "messages/estimates.h"
#include "navigation/gestalt/gestalt_params.h"

namespace rockyard::navigation {

// The sideways way over the driven way, both averaged over the last memory_m or so:
//   D = sum w u / sum w |ds|,  w = exp(-(driven since) / memory_m),
// with u the part of a correction of the estimate that is square to the rover's heading. D is a
// vector of O: on a slope the rover drifts downhill, whichever way it turns.
class Drift {
 public:
  explicit Drift(const AgainstDriftParams& params) : params_(params) {}

  // Takes a correction that has moved the rover by left_m to its left. One that is more than
  // max_angle of the way since the last one is no drift (a fix by an aid, a turn in place).
  void Correct(const messages::PoseEstimate& rover_O, double left_m);

  // Returns the angle from the heading to the way that the rover makes good on it, positive left:
  // atan of D's part to the left.
  double Angle_rad(double heading_rad) const;

 private:
  AgainstDriftParams params_;
  double odometer_m_ = 0.0;  // at the last correction
  double x_m_ = 0.0;         // sum w u
  double y_m_ = 0.0;
  double driven_m_ = 0.0;  // sum w |ds|
};

}  // namespace rockyard::navigation
