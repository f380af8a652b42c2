// When and where a rover looked.
#pragma once

#include <cstdint>

#include "messages/estimates.h"

namespace rockyard::messages {

// The moment at which data were taken that may be delivered much later, as the rover believed it
// then. A pose in the odometry frame keeps its meaning whatever corrects the estimate since.
struct LookMoment {
  std::int64_t number = 0;  // of the look
  double time_s = 0.0;      // on-board clock
  PoseEstimate estimate;    // in the world frame
  PoseEstimate odometry;    // in the odometry frame
  AttitudeEstimate attitude;
};

}  // namespace rockyard::messages
