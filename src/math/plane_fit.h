// Planes through points, by total least squares. GESTALT's maps fit patches whose outliers are left
// out by it, one by one, and all other patches by plane_batch.h, which must give the same bits.
#pragma once

#include <cmath>
#include <limits>

#include "math/functions.h"
#include "math/pose.h"
#include "math/symmetric_eigen.h"

namespace rockyard::math {

// Returns the angle between the level and a plane with that unit normal, z >= 0, in [0, pi/2].
inline double Slope_rad(const Vector3& normal) {
  return Atan2(std::sqrt(normal.x() * normal.x() + normal.y() * normal.y()), normal.z());
}

// The plane through the mean of points that makes the sum of squared distances from it least. Its
// normal is the axis of the smallest eigenvalue of their covariance.
struct PlaneFit {
  Vector3 normal = Vector3::UnitZ();  // unit, z >= 0
  // Root mean square of the points' distances from the plane: the root of the smallest eigenvalue.
  // It resolves about 1e-8 of the extent of the points.
  double residual_m = 0.0;
  // The middle over the smallest eigenvalue, from 1 (no plane) to infinity (points in a plane).
  // 1 where all points lie in a line, or in one place.
  double eigen_ratio = 1.0;

  // Returns the angle between the plane and the level, in [0, pi/2].
  double Slope_rad() const { return math::Slope_rad(normal); }
};

// Returns the plane, given the eigenvalues of the covariance and the axis of the smallest.
inline PlaneFit PlaneFrom(double smallest_m2, double middle_m2, double largest_m2,
                          const Vector3& axis) {
  // Rounding leaves up to this much, of either sign, of an eigenvalue of zero. PlanesOf in
  // plane_lanes.h must have the same floor: a plane has the same bits by itself and in a batch, as
  // maps fit both ways.
  const double floor = 4.0 * std::numeric_limits<double>::epsilon() * largest_m2;
  PlaneFit fit;
  fit.normal = axis.z() < 0.0 ? Vector3(-axis) : axis;
  if (smallest_m2 > floor) {
    fit.residual_m = std::sqrt(smallest_m2);
    fit.eigen_ratio = middle_m2 / smallest_m2;
  } else if (middle_m2 > floor) {
    fit.eigen_ratio = std::numeric_limits<double>::infinity();
  }
  return fit;
}

// Returns the plane of points with that covariance. Cost: about 0.1 us; plane_batch.h fits each of
// many planes in a fraction of that.
inline PlaneFit FitPlane(const SymmetricMatrix3& covariance_m2) {
  const SymmetricEigen3 eigen = EigenOf(covariance_m2);
  return PlaneFrom(eigen.values[0], eigen.values[1], eigen.values[2], eigen.smallest_axis);
}

}  // namespace rockyard::math
