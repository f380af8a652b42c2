// What the sensors report.
#pragma once

#include <array>
#include <cstdint>

#include "messages/wheels.h"

namespace rockyard::messages {

// Wheel encoders and turn-rate gyro over one on-board tick.
struct MotionMeasurement {
  double duration_s = 0.0;
  PerWheel<double> wheel_turn_rad{};  // encoder increment of each drive motor
  double turn_rad = 0.0;              // integrated gyro rate, positive left
};

// Light stripe sensor: rows run from the nearest point (0) to the farthest (3) along each laser,
// stripes from the rover's left (0) to its right (4). Matthies 1995, figure 13.
inline constexpr std::size_t kStripeRows = 4;
inline constexpr std::size_t kStripes = 5;

template <typename T>
using StripeArray = std::array<std::array<T, kStripes>, kStripeRows>;  // [row][stripe]

// One point as it was found in the image.
struct StripePixel {
  bool detected = false;
  double column_px = 0.0;  // on the scanline of its row, of the camera assigned to its stripe
};

struct StripeScan {
  std::int64_t number = 0;  // counts every scan of the trial from 0
  StripeArray<StripePixel> pixels{};
};

}  // namespace rockyard::messages
