// Drives a rover straight ahead against what lies across its way.
#pragma once

#include <algorithm>
#include <memory>

#include "rover_drive.h"

namespace rockyard::rover {

enum class Climb { kUp, kStuck, kTippedOver };

// How a drive ended, and what it saw.
struct Climbed {
  Climb how = Climb::kStuck;
  double x_m = 0.0;
  bool body_touched = false;  // anything but wheels
};

// Drives ahead until the rover's origin is at `until_x_m`, it has tipped by 60 deg, or its rims
// have turned by 0.3 m without a gain of 3 mm.
inline Climbed ClimbAhead(Rover& rover, const RoverParams& params, double speed_m_s,
                          double until_x_m, double patience_m = 0.3) {
  const messages::WheelCommand command = Drive(params, speed_m_s, 0.0);
  const double patience_s = patience_m / speed_m_s;
  Climbed climbed{.x_m = rover.state().X_WR.translation().x()};
  for (double waited_s = 0.0; waited_s < patience_s; waited_s += rover.step_s()) {
    rover.Step(command);
    const truth::RoverState& state = rover.state();
    climbed.body_touched |= !state.contacts.empty();
    const double x_m = state.X_WR.translation().x();
    if (math::Tilt(state.X_WR) > math::DegToRad(60.0)) {
      climbed.how = Climb::kTippedOver;
      return climbed;
    }
    if (x_m > until_x_m) {
      climbed.how = Climb::kUp;
      return climbed;
    }
    if (x_m > climbed.x_m + 0.003) {
      climbed.x_m = x_m;
      waited_s = 0.0;
    }
  }
  return climbed;
}

}  // namespace rockyard::rover
