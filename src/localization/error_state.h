/// @file
/// What the error-state filter keeps account of.
#pragma once

#include <Eigen/Core>

#include "messages/estimates.h"

namespace rockyard::localization {

/// Rows of the error, which is true less believed. The first six are those of
/// messages::PoseCoordinate, in W, m and rad; the others say how wrong sensors are read, the
/// rover's own and the pan axis of the lander's mast. The filter lists its prior, and remembers
/// covariances overnight, in this order.
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
  kGyroScale,   ///< of measured over true turn
  kWheelScale,  ///< of true over believed way
  kPan,         ///< rad, of the lander's frame about the lander, in W
};
static_assert(kHeading == messages::Index(messages::PoseCoordinate::kHeading));

}  // namespace error

/// How many rows there are.
inline constexpr int kErrorCoordinates = 10;

/// The error, and its covariance: 10 and 10 x 10, in the units of the rows.
using ErrorVector = Eigen::Matrix<double, kErrorCoordinates, 1>;
using ErrorMatrix = Eigen::Matrix<double, kErrorCoordinates, kErrorCoordinates>;

}  // namespace rockyard::localization
