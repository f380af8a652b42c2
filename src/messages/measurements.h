/// @file
/// What the sensors report, and a tracker of features: simulated sensors write these messages,
/// estimators and perception read them.
#pragma once

#include <cstdint>

#include "messages/stripe_array.h"
#include "messages/wheels.h"

namespace rockyard::messages {

/// Wheel encoders, steering angles and turn-rate gyro over one on-board tick.
struct MotionMeasurement {
  double duration_s = 0.0;            ///< of the tick, > 0
  PerWheel<double> wheel_turn_rad{};  ///< encoder increment of each drive motor
  PerWheel<double> steer_rad{};       ///< at the end of the tick, positive left
  double turn_rad = 0.0;              ///< integrated gyro rate, positive left
};

/// One point of the stripe array as it was found in the image (words: stripe_array.h).
struct StripePixel {
  bool detected = false;   ///< whether it was found
  double column_px = 0.0;  ///< image column on the point's scanline, in its StripeLaser::camera
};

/// One scan of the light stripe sensor: the image column of each point.
struct StripeScan {
  std::int64_t number = 0;  ///< counts every scan of the trial from 0
  StripeArray<StripePixel> pixels;
};

/// Where the feature lies that the rover drives to, as seen from R's origin in the levelled rover
/// frame.
struct FeatureSighting {
  double range_m = 0.0;      ///< horizontal, >= 0
  double bearing_rad = 0.0;  ///< from the heading, positive left, within [-pi, pi]
};

}  // namespace rockyard::messages
