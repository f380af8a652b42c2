// Planes through points, by total least squares.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/pose.h"
#include "math/symmetric_eigen.h"

namespace rockyard::math {

// The plane through the mean of points that makes the sum of squared distances from it least. Its
// normal is the axis of the smallest eigenvalue of their covariance.
struct PlaneFit {
  Vector3 normal = Vector3::UnitZ();  // unit, z >= 0
  // Root mean square of the points' distances from the plane: sqrt of the smallest eigenvalue.
  // Resolves about 1e-8 of the extent of the points.
  double residual_m = 0.0;
  // The middle over the smallest eigenvalue, from 1 (no plane) to infinity (points in a plane).
  // 1 where all points lie in a line, or in one place.
  double eigen_ratio = 1.0;

  // Angle between the plane and the level, in [0, pi/2].
  double Slope_rad() const { return std::atan2(std::hypot(normal.x(), normal.y()), normal.z()); }
};

inline PlaneFit FitPlane(const SymmetricMatrix3& covariance_m2) {
  const SymmetricEigen3 eigen = EigenOf(covariance_m2);
  // What rounding leaves of an eigenvalue of zero, of either sign.
  const double floor = 4.0 * std::numeric_limits<double>::epsilon() * eigen.values[2];
  PlaneFit fit;
  fit.normal = eigen.smallest_axis.z() < 0.0 ? Vector3(-eigen.smallest_axis) : eigen.smallest_axis;
  if (eigen.values[0] > floor) {
    fit.residual_m = std::sqrt(eigen.values[0]);
    fit.eigen_ratio = eigen.values[1] / eigen.values[0];
  } else if (eigen.values[1] > floor) {
    fit.eigen_ratio = std::numeric_limits<double>::infinity();
  }
  return fit;
}

}  // namespace rockyard::math
