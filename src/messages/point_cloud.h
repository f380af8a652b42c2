/// @file
/// What a range sensor hands to on-board software: map-based navigators fill their map with it, and
/// elevations for the hazard detector are taken from it.
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
  std::vector<math::Vector3> points_R;  ///< m, in R as the rover believes; readers need no order
};

/// The moment of a look, and what the rover believed then: the look's data may be delivered much
/// later. A pose in the odometry frame keeps its meaning whatever corrects the estimate meanwhile.
struct LookMoment {
  std::int64_t number = 0;    ///< of the look
  double time_s = 0.0;        ///< on-board clock
  PoseEstimate estimate;      ///< in the frame in which goals are told
  PoseEstimate odometry;      ///< in the odometry frame
  AttitudeEstimate attitude;  ///< believed stance
};

}  // namespace rockyard::messages
