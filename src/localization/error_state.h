/// @file
/// The rows of the error that the error-state filter keeps account of. Estimators remember its
/// covariance overnight, and missions carry it from sol to sol.
#pragma once

#include <Eigen/Core>

#include "messages/estimates.h"

namespace rockyard::localization {

/// Rows of the error, which is true less believed. The first six are those of
/// messages::PoseCoordinate, in W, m and rad; the others say how wrong sensors are read, the
/// rover's own and the pan axis of the lander's mast. Must stay: the filter lists its prior
/// (PriorCovariance) in this order, with the pose first.
namespace error {

/// Indices of rows and columns.
enum Row : int {
  kX,
  kY,
  kZ,
  kRoll,
  kPitch,
  kHeading,
  kGyroBias,    ///< rad/s
  kGyroScale,   ///< measured over true turn
  kWheelScale,  ///< true over rolled way
  kPan,         ///< rad: by how much the lander's frame is turned about the lander, in W
};
static_assert(kHeading == messages::Index(messages::PoseCoordinate::kHeading));

}  // namespace error

/// How many rows the error has.
inline constexpr int kErrorCoordinates = 10;

/// The error, and its covariance: 10 and 10 x 10, in the units of the rows.
using ErrorVector = Eigen::Matrix<double, kErrorCoordinates, 1>;
using ErrorMatrix = Eigen::Matrix<double, kErrorCoordinates, kErrorCoordinates>;

}  // namespace rockyard::localization
