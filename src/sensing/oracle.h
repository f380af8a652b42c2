// Perfect localization: a sensor without noise, marked in the results of every run that uses it.
#pragma once

#include "messages/estimates.h"
#include "truth/rover_state.h"

namespace rockyard::sensing {

// The true pose as an operator's message; perception::DeadReckoning::Follow takes one per tick.
inline messages::PoseUpdate TruePose(const truth::RoverState& state) {
  const math::Pose2 pose = math::ToPose2(state.X_WR);
  return {pose.x_m, pose.y_m, pose.heading_rad};
}

}  // namespace rockyard::sensing
