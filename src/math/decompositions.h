// Decompositions of Eigen that take seconds to compile, compiled once. Estimates of motions and
// calibrations use them; each is by the method named, whose rounding their results hang on.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace rockyard::math {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Returns x with N x = right, of a symmetric N that is not singular (LDL').
Vector6 SolveSymmetric(const Matrix6& N, const Vector6& right);

// Returns the inverse of a matrix that is not singular (LU).
Matrix6 InverseOf(const Matrix6& matrix);

// Returns the inverse of a symmetric N, or nothing where it has a negative eigenvalue (LDL').
std::optional<Matrix6> InverseOfPositive(const Matrix6& N);

// Returns the largest eigenvalue of a symmetric matrix.
double LargestEigenvalue(const Eigen::Matrix3d& matrix);

// matrix = U diag(values) V', the largest value first, none negative.
struct SingularValues {
  Eigen::Matrix3d U;
  Eigen::Vector3d values;
  Eigen::Matrix3d V;
};
SingularValues SingularValuesOf(const Eigen::Matrix3d& matrix);

}  // namespace rockyard::math
