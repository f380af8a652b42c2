/// @file
/// What a range sensor hands to on-board software.
#pragma once

#include <cstdint>
#include <vector>

#include "math/pose.h"
#include "messages/estimates.h"

namespace rockyard::messages {

/// Where the rover looks: cameras at its front or at its rear.
enum class LookDirection { kAhead, kBehind };

/// Points on surfaces that are visible from the rover's present position (Goldberg 2002, section
/// 4), from any range sensor.
struct PointCloud {
  std::int64_t number = 0;                          ///< counts every look of the trial from 0
  LookDirection direction = LookDirection::kAhead;  ///< where the rover looked
  std::vector<math::Vector3> points_R;  ///< m, in R as the rover's calibration has it; no order
};

/// The moment at which data were taken that may be delivered much later, as the rover believed it
/// then. A pose in the odometry frame keeps its meaning whatever corrects the estimate since.
struct LookMoment {
  std::int64_t number = 0;    ///< of the look
  double time_s = 0.0;        ///< on-board clock
  PoseEstimate estimate;      ///< in the world frame
  PoseEstimate odometry;      ///< in the odometry frame
  AttitudeEstimate attitude;  ///< at that moment
};

}  // namespace rockyard::messages
