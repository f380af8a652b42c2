// What aids of localization measure: poses, and motions between two of them.
#pragma once

#include <bitset>
#include <cstdint>

#include "messages/estimates.h"

namespace rockyard::messages {

// The moment at which data of an aid were taken, which may arrive much later. Counts from 0 in a
// drive; each moment has a number of its own.
using CaptureNumber = std::int64_t;

// A measured pose in the world frame: a lander's fix, the sun's azimuth, an operator. Coordinates
// that were not measured are ignored, with their rows and columns.
struct PoseFix {
  CaptureNumber capture = 0;
  std::bitset<kPoseCoordinates> measured;  // by Index of a coordinate
  PoseVector pose_W = PoseVector::Zero();
  PoseCovariance covariance = PoseCovariance::Identity();
};

// A measured motion: what the pose coordinates at the second moment are less those at the first
// one, in the levelled frame of the first (x along its heading). By visual odometry.
struct RelativeMotion {
  CaptureNumber from = 0;
  CaptureNumber to = 0;
  PoseVector motion_F = PoseVector::Zero();
  PoseCovariance covariance = PoseCovariance::Identity();
};

}  // namespace rockyard::messages
