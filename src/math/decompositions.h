// Decompositions of matrices by Eigen. Visual odometry, camera calibration and the cylinder finders
// estimate with them. They stand in one file because Eigen's headers take seconds to compile.
//
// Must stay: the method that each function names. Results of the estimates depend on its rounding.
// Arguments are not checked.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace rockyard::math {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Returns x with N x = right for a symmetric N that is not singular. Method: LDL'.
Vector6 SolveSymmetric(const Matrix6& N, const Vector6& right);

// Returns the inverse of a matrix that is not singular. Method: LU.
Matrix6 InverseOf(const Matrix6& matrix);

// Returns the inverse of a symmetric N that is not singular, or nothing where N has a negative
// eigenvalue. Method: LDL'.
std::optional<Matrix6> InverseOfPositive(const Matrix6& N);

// Returns the largest eigenvalue of a symmetric matrix. Method: SelfAdjointEigenSolver, eigenvalues
// only.
double LargestEigenvalue(const Eigen::Matrix3d& matrix);

// The decomposition matrix = U diag(values) V', the largest value first, none negative. U and V may
// be reflections. Method: JacobiSVD.
struct SingularValues {
  Eigen::Matrix3d U;
  Eigen::Vector3d values;
  Eigen::Matrix3d V;
};
SingularValues SingularValuesOf(const Eigen::Matrix3d& matrix);

}  // namespace rockyard::math
