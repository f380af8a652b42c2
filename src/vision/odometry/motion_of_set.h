// From a consistent set to the motion of all points that moved with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "vision/odometry/consistent_set.h"
#include "vision/odometry/estimate_motion.h"

namespace rockyard::vision {

struct SetMotion {
  EstimatedMotion estimated;         // of the members; iterations of all rounds
  std::vector<std::size_t> members;  // indices of points, ascending
};

// Estimates the motion of the set; takes as the set what is with that motion (PointsWith), and so
// on until the set stays, five times at most. Motions of three points, and distances that are
// known badly, leave out many that moved alike: on real tracks the motion of a first set is wrong
// by up to four times as much. `set` has three points or more.
SetMotion MotionOfSet(const PointsSeenTwice& points, const RectifiedPair& cameras,
                      const ConsistentSet& set, const SelectionParams& selection,
                      const EstimationParams& estimation);

}  // namespace rockyard::vision
