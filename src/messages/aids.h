/// @file
/// What aids of localization measure: a pose, a motion between two moments, the sun's direction,
/// range and bearing from a beacon. Simulated aids and on-board software write these messages, and
/// estimators take fixes and motions.
#pragma once

#include <Eigen/Core>
#include <bitset>
#include <cstdint>

#include "messages/estimates.h"

namespace rockyard::messages {

/// The moment at which data of an aid were taken, which may arrive much later. Counts from 0 in a
/// drive; each moment has a number of its own, larger than those before: estimators take the order
/// of numbers for the order in time.
using CaptureNumber = std::int64_t;

/// A measured pose: a lander's fix, a heading from the sun, a place from a beacon. Coordinates that
/// were not measured are ignored, with their rows and columns of the covariance.
struct PoseFix {
  CaptureNumber capture = 0;
  std::bitset<kPoseCoordinates> measured;  ///< by Index of a coordinate
  PoseVector pose = PoseVector::Zero();    ///< in W, or in the lander's frame (in_lander_frame)
  PoseCovariance covariance =
      PoseCovariance::Identity();  ///< m, rad; in the order of PoseCoordinate
  /// Whether the pose was seen from the mast that designates goals: its error of the pan angle is
  /// then in both.
  bool in_lander_frame = false;
};

/// A motion measured by visual odometry: the pose coordinates at the second moment less those at
/// the first one, in the levelled frame of the first (x along its heading).
struct RelativeMotion {
  CaptureNumber from = 0;                    ///< the first moment
  CaptureNumber to = 0;                      ///< the second one, later
  PoseVector motion_F = PoseVector::Zero();  ///< F: the levelled frame at the first moment
  PoseCovariance covariance = PoseCovariance::Identity();
};

/// The sun as a sun sensor sees it.
struct SunSighting {
  CaptureNumber capture = 0;
  Eigen::Vector3d sun_R = Eigen::Vector3d::UnitZ();  ///< unit vector to the sun, in R
  double direction_sd_rad = 0.0;                     ///< of either angle across that direction
};

/// What a radio beacon on the lander measures of the answerer on the rover.
struct BeaconReading {
  CaptureNumber capture = 0;
  double station_x_m = 0.0;  ///< of the beacon, in W
  double station_y_m = 0.0;
  double range_m = 0.0;      ///< horizontal
  double bearing_rad = 0.0;  ///< of the rover as seen from the station, from +x towards +y
  double range_sd_m = 0.0;   ///< standard deviation of range_m
  double bearing_sd_rad = 0.0;
};

}  // namespace rockyard::messages
