/// @file
/// What on-board code believes, and what operators tell it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "messages/measurements.h"

namespace rockyard::messages {

/// Pose as estimated on board, and the distance integrated on the way.
struct PoseEstimate {
  double x_m = 0.0;          ///< in the frame that the user of it names
  double y_m = 0.0;          ///< to the left of x
  double heading_rad = 0.0;  ///< from +x towards +y
  double distance_m = 0.0;   ///< odometer: integral of |forward increments|
};

/// What the rover believes of its stance, beside its planar pose.
struct AttitudeEstimate {
  double roll_rad = 0.0;   ///< about x of the levelled rover frame, positive: left side up
  double pitch_rad = 0.0;  ///< about y, positive: nose down
  double z_m = 0.0;        ///< of R's origin above where the drive began
};

/// The coordinates of a pose in vectors and covariances, m and rad.
enum class PoseCoordinate { kX, kY, kZ, kRoll, kPitch, kHeading };
/// How many there are.
inline constexpr int kPoseCoordinates = 6;

/// Returns the row of a coordinate.
constexpr int Index(PoseCoordinate coordinate) { return static_cast<int>(coordinate); }

/// Six coordinates, and their covariance, in the order of PoseCoordinate.
using PoseVector = Eigen::Matrix<double, kPoseCoordinates, 1>;
using PoseCovariance = Eigen::Matrix<double, kPoseCoordinates, kPoseCoordinates>;

/// Where the rover is in the world frame, beside the lander's frame that it drives in.
struct WorldEstimate {
  PoseEstimate pose;
  PoseCovariance covariance = PoseCovariance::Zero();
};

/// All that the rover believes of where it is, in six degrees of freedom.
struct LocalizationEstimate {
  /// Corrected, in the frame in which goals are told: what a goal is reached by. Aids make it jump.
  /// That is the world frame, or the lander's: the world's, turned about the lander by what its
  /// mast is wrong by (Matthies 1995, section 4, eq. 3).
  PoseEstimate pose;
  AttitudeEstimate attitude;
  /// In the frame of its own odometry, which aids leave alone: what a map and a manoeuvre go by.
  /// Both frames are one until the first correction, and again after operators moved the rover.
  PoseEstimate odometry;
  /// Of pose and attitude; empty where the rover keeps no account of its error.
  std::optional<PoseCovariance> covariance;
  /// Empty where the rover does not tell the two frames apart.
  std::optional<WorldEstimate> world;
};

/// Where operators say that the rover is after they moved it by hand, in the world frame.
struct PoseUpdate {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  /// They mirrored what the rover believed about a line along x, as they did with the rover: nobody
  /// measured where it is, so that its error is the mirror image of what it was.
  bool mirrored = false;
};

/// Where the rover is to go, in the frame in which goals are told.
struct Goal {
  double x_m = 0.0;
  double y_m = 0.0;
};

/// Elevation of one light-stripe point above the sensor's datum plane.
struct ElevationPoint {
  bool detected = false;     ///< whether the point was found in the image
  double elevation_m = 0.0;  ///< above the datum plane
};

/// What the stripe finder made of one scan.
struct ElevationScan {
  std::int64_t number = 0;  ///< counts every scan of the trial from 0
  StripeArray<ElevationPoint> points;
};

/// Which stripes see a hazard; left to right as in StripeScan.
struct HazardReport {
  /// Number of the scan, from 0.
  std::int64_t scan_number = 0;
  PerStripe<bool> stripe_hazard;

  /// Returns whether any stripe does.
  bool any() const {
    for (const bool hazard : stripe_hazard) {
      if (hazard) return true;
    }
    return false;
  }
};

/// Corners of a way in the frame in which goals are told, the first one to drive to first, without
/// the start; the last one is exactly the goal, which a follower replaces where the goal moves.
/// Empty: there is no way.
struct Route {
  std::vector<Goal> corners;
};

}  // namespace rockyard::messages
