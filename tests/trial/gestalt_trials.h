// Drives of the map-based navigator for the tests of the closed loop.
#pragma once

#include "scenario/shipped.h"
#include "trial/pathfinder_trials.h"

namespace rockyard::trial {

inline DriveParams Gestalt(const std::string& name, const Overrides& overrides = {}) {
  return scenario::Shipped("gestalt/" + name, overrides).drive;
}

inline Overrides operator+(Overrides a, const Overrides& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// 3 m of empty sand, without errors of sensors.
inline const Overrides kShortAndEmpty = {"terrain.rocks.kind=none", "course.goal_x_m=3"};
inline const Overrides kTrueEncoders = {"sensors.encoders.distance_variance_m2_per_m=0",
                                        "sensors.encoders.physics_variance_m2_per_m=0",
                                        "sensors.gyro.heading_variance_deg2_per_m=0"};

}  // namespace rockyard::trial
