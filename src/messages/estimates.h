/// @file
/// What on-board code believes, and what operators tell it. Estimators, perception and navigators
/// hand these messages to one another; the record of a drive holds them against the truth.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "messages/measurements.h"

namespace rockyard::messages {

/// A pose as estimated on board, and the distance integrated on the way.
struct PoseEstimate {
  double x_m = 0.0;          ///< in the frame that the holder of the estimate names
  double y_m = 0.0;          ///< to the left of x
  double heading_rad = 0.0;  ///< from +x towards +y
  double distance_m = 0.0;   ///< odometer: integral of |forward increments|
};

/// What the rover believes of its stance, beside its pose in the plane.
struct AttitudeEstimate {
  double roll_rad = 0.0;   ///< about x of the levelled rover frame, positive: left side up
  double pitch_rad = 0.0;  ///< about y, positive: nose down
  double z_m = 0.0;        ///< of R's origin above where the drive began
};

/// The coordinates of a pose in vectors and covariances, m and rad.
enum class PoseCoordinate { kX, kY, kZ, kRoll, kPitch, kHeading };
/// How many coordinates a pose has.
inline constexpr int kPoseCoordinates = 6;

/// Returns the row of a coordinate in vectors and covariances.
constexpr int Index(PoseCoordinate coordinate) { return static_cast<int>(coordinate); }

/// Six coordinates, and their covariance, in the order of PoseCoordinate.
using PoseVector = Eigen::Matrix<double, kPoseCoordinates, 1>;
using PoseCovariance = Eigen::Matrix<double, kPoseCoordinates, kPoseCoordinates>;

/// Where the rover believes to be in the world frame, when its goals are told in the lander's.
struct WorldEstimate {
  PoseEstimate pose;
  PoseCovariance covariance = PoseCovariance::Zero();
};

/// All that the rover believes of where it is, in six degrees of freedom.
struct LocalizationEstimate {
  /// The corrected pose, by which a goal is reached; aids make it jump. It lies in the frame in
  /// which goals are told: the world frame W, or the lander's, which is W turned about the lander
  /// by the error of its mast's pan angle (Matthies 1995, section 4, eq. 3).
  PoseEstimate pose;
  AttitudeEstimate attitude;
  /// The pose in the frame of odometry, which aids leave alone: maps and manoeuvres go by it.
  /// `pose` and `odometry` are equal until the first correction, and again after operators moved
  /// the rover.
  PoseEstimate odometry;
  /// Covariance of pose and attitude; empty where the rover keeps no account of its error.
  std::optional<PoseCovariance> covariance;
  /// The pose in W; empty where the rover does not tell W and the lander's frame apart.
  std::optional<WorldEstimate> world;
};

/// Where operators say that the rover is after they moved it by hand, in the world frame.
struct PoseUpdate {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
  /// Whether the pose is the believed one, mirrored about a line along x as the rover was. Nobody
  /// measured where the rover is, so that its error is the mirror image of what it was.
  bool mirrored = false;
};

/// Where the rover is to go, in the frame in which goals are told.
struct Goal {
  double x_m = 0.0;
  double y_m = 0.0;
};

/// The elevation of one light-stripe point.
struct ElevationPoint {
  bool detected = false;     ///< whether the point was found in the image
  double elevation_m = 0.0;  ///< above the datum plane (StripeCalibration::datum_z_m)
};

/// Elevations of the points of one look, by which the hazard detector judges the ground.
struct ElevationScan {
  std::int64_t number = 0;  ///< counts every scan of the trial from 0
  StripeArray<ElevationPoint> points;
};

/// Which stripes show a hazard, from left to right; behaviour controllers steer by it.
struct HazardReport {
  std::int64_t scan_number = 0;  ///< counts every scan of the trial from 0
  PerStripe<bool> stripe_hazard;

  /// Returns whether any stripe shows a hazard.
  bool any() const {
    for (const bool hazard : stripe_hazard) {
      if (hazard) return true;
    }
    return false;
  }
};

/// A way that somebody else planned, for the navigator that follows a route. Its corners are in the
/// frame in which goals are told and in the order of driving, without the start. Must stay: the
/// last corner is exactly the goal, which a follower replaces where the goal moves.
struct Route {
  std::vector<Goal> corners;  ///< empty: there is no way
};

}  // namespace rockyard::messages
