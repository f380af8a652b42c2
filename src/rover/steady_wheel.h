// One wheel that a carriage leads over level soil at a steady speed, as rigs measure it: what
// WheelOnSoil says of it. The command `mobility` and Python take it; a rover comes to the same when
// its wheels have dug in for their slip (SlipSinkage).
//
// With the speed v of the carriage, which heads by the slip angle a away from the plane of the
// wheel, and the speed w of the rim, the slip is i = (w - v) / max(w, v). The contact slides by
//   s = (1 - v cos a / w, v sin a / w)
// over the speed of the rim, along and across the wheel. Of the answer to the load and to
// d = min(|s|, 1) the traction T = T_max tau(u |s|) acts along s, R against the way, B across:
//   pull = T s_along / |s| - R,   side = T s_across / |s| + B,   torque = r T s_along / |s|.
#pragma once

#include "rover/wheel_law_params.h"

namespace rockyard::rover {

// What a wheel does to its carriage, and the soil to it.
struct SteadyForces {
  double pull_N = 0.0;  // forward, in the plane of the wheel
  double side_N = 0.0;  // across it, against the way that it slides; of the sign of the slip angle
  double torque_Nm = 0.0;
  double sinkage_m = 0.0;
  double resistance_N = 0.0;  // R
};

// Returns the forces on a wheel of radius_m under a load, at a slip in (-1, 1) and a slip angle in
// [-pi/2, pi/2]. Throws core::UserError where one of them is out of bounds. A call costs 0.1 us.
SteadyForces SteadyWheel(const WheelOnSoil& soil, double radius_m, double load_N, double slip,
                         double slip_angle_rad = 0.0);

}  // namespace rockyard::rover
