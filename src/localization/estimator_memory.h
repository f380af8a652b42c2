// What an on-board computer keeps of its estimate while it is switched off, as over a night.
#pragma once

#include <optional>

#include "localization/error_state.h"
#include "math/pose.h"

namespace rockyard::localization {

// What an estimator of the same kind begins with when the computer is switched on again, at the
// place where the rover stood. Odometer, roll, pitch and height begin anew, and data that aids took
// before are of no use any more.
struct EstimatorMemory {
  math::Pose2 pose;  // as believed, in W
  // Of estimators that keep account of their error; empty for others.
  std::optional<ErrorMatrix> covariance;  // rows as in error_state.h
  double gyro_scale = 1.0;                // measured over true turn, as believed
  double wheel_scale = 1.0;               // true over rolled way, as believed
};

}  // namespace rockyard::localization
