// Covariances of places that are known in polar coordinates.
#pragma once

#include <Eigen/Geometry>

namespace rockyard::math {

// Covariance in x and y of a place that is known to along_sd along the direction bearing_rad (from
// +x towards +y) and to across_sd across it.
inline Eigen::Matrix2d PolarCovariance(double bearing_rad, double along_sd, double across_sd) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(bearing_rad).toRotationMatrix();
  const Eigen::Vector2d variances(along_sd * along_sd, across_sd * across_sd);
  return turn * variances.asDiagonal() * turn.transpose();
}

}  // namespace rockyard::math
