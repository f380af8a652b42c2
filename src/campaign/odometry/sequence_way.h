// Where a rover stands when it takes the pairs of images of a sequence.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/pose.h"
#include "messages/estimates.h"

namespace rockyard::campaign {

// `count` poses in W, the first of them `start`: from each to the next it is `step_m` (backwards
// where negative, 0: it stays) along a circle on which the heading grows by `turn_rad`:
//   chord = step sin(turn / 2) / (turn / 2), in the direction of heading + turn / 2.
// Requires count >= 1.
std::vector<math::Pose2> CircleWay(const math::Pose2& start, std::int64_t count, double step_m,
                                   double turn_rad);

// The way from `start` along straight lines through `corners`, in at most `count` poses: at each
// corner it turns on the spot, in equal turns of at most `turn_rad`, then it drives in steps of
// `step_m`, the last one to the corner as long as it needs. Corners nearer than 1 mm are passed
// over. Requires count >= 1, step_m > 0, turn_rad > 0.
std::vector<math::Pose2> CornerWay(const math::Pose2& start,
                                   std::span<const messages::Goal> corners, std::int64_t count,
                                   double step_m, double turn_rad);

}  // namespace rockyard::campaign
