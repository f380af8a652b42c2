// What a range sensor hands to on-board software.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose.h"

namespace rockyard::messages {

// Where the rover looks: cameras at its front or at its rear.
enum class LookDirection { kAhead, kBehind };

// Points on surfaces that are visible from the rover's present position (Goldberg 2002, section 4),
// from any range sensor.
struct PointCloud {
  std::int64_t number = 0;  // counts every look of the trial from 0
  LookDirection direction = LookDirection::kAhead;
  std::vector<math::Vector3> points_R;  // m, in R as the rover's calibration has it; no order
};

}  // namespace rockyard::messages
