#include "math/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace rockyard::math {

Vector6 SolveSymmetric(const Matrix6& N, const Vector6& right) { return N.ldlt().solve(right); }

Matrix6 InverseOf(const Matrix6& matrix) { return matrix.inverse(); }

std::optional<Matrix6> InverseOfPositive(const Matrix6& N) {
  const Eigen::LDLT<Matrix6> factors(N);
  if (!factors.isPositive()) return std::nullopt;
  return factors.solve(Matrix6::Identity());
}

double LargestEigenvalue(const Eigen::Matrix3d& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

SingularValues SingularValuesOf(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace rockyard::math
