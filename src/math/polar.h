// Covariances of places that are seen from a point: the lander's fixes of the rover. Records of
// drives with such fixes (sensing/aids.cc) depend on its bits, as estimators weigh fixes by it.
#pragma once

#include <Eigen/Core>

#include "math/functions.h"

namespace rockyard::math {

// Returns the covariance in x and y of a place whose errors along and across the direction
// bearing_rad (from +x towards +y) are independent. Their standard deviations along_sd and
// across_sd are lengths of one unit: across_sd is the range times the deviation of the bearing.
inline Eigen::Matrix2d PolarCovariance(double bearing_rad, double along_sd, double across_sd) {
  const auto [s, c] = SinCos(bearing_rad);
  Eigen::Matrix2d turn;
  turn << c, -s, s, c;
  const Eigen::Vector2d variances(along_sd * along_sd, across_sd * across_sd);
  return turn * variances.asDiagonal() * turn.transpose();
}

}  // namespace rockyard::math
