// Perfect localization: a sensor without noise, marked in the results of every run that uses it.
#pragma once

#include <cmath>

#include "messages/estimates.h"
#include "truth/rover_state.h"

namespace rockyard::sensing {

// Returns the true pose as an operator's message.
inline messages::PoseUpdate TruePose(const truth::RoverState& state) {
  const math::Pose2 pose = math::ToPose2(state.X_WR);
  return {pose.x_m, pose.y_m, pose.heading_rad};
}

// Returns what the pose in the plane leaves out: the attitude by which math::MakePose gives back
// the orientation, and the height above the one at which the drive began.
inline messages::AttitudeEstimate TrueAttitude(const truth::RoverState& state, double start_z_m) {
  const auto& R_WR = state.X_WR.linear();
  return {.roll_rad = std::atan2(R_WR(2, 1), R_WR(2, 2)),
          .pitch_rad = std::atan2(-R_WR(2, 0), std::hypot(R_WR(2, 1), R_WR(2, 2))),
          .z_m = state.X_WR.translation().z() - start_z_m};
}

}  // namespace rockyard::sensing
