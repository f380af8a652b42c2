// Points from disparities of an aligned pair, with what is known of their errors.
//
//   p = C_left + Z n    n = M^-1 (column, row, 1), M of the rows H, V, A    Z = H . b / disparity
//
// b is the baseline C_right - C_left. With f h' = H - (H . A) A along the baseline Z is
// f |b| / disparity; it grows with the disparity's error as dZ = Z^2 / (f |b|) ddisparity.
#pragma once

#include <optional>

#include "vision/cameras/rectification.h"

namespace rockyard::vision {

struct TriangulatedPoint {
  math::Vector3 p_A = math::Vector3::Zero();  // m, in the cameras' outer frame
  // Of p_A by column, row (of the left image) and disparity, m per pixel.
  Eigen::Matrix3d by_measurement = Eigen::Matrix3d::Zero();

  // The covariance of p_A, m^2, to first order in that of column, row and disparity, px^2.
  Eigen::Matrix3d Covariance(const Eigen::Matrix3d& measurement_px2) const {
    return by_measurement * measurement_px2 * by_measurement.transpose();
  }
};

// The point at a pixel of the left image with its disparity, column_left - column_right. Nothing
// where the disparity is not positive (at or beyond infinity) or where a number is not finite.
std::optional<TriangulatedPoint> Triangulate(const Cahv& left, const Cahv& right,
                                             const Pixel& left_pixel, double disparity_px);

}  // namespace rockyard::vision
