// What is decomposed, put together again.
#include "math/decompositions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace rockyard::math {
namespace {

constexpr double kTolerance = 1e-12;

Eigen::Matrix3d Turn(double x, double y, double z) {
  return Eigen::AngleAxisd(1.0, Eigen::Vector3d(x, y, z).normalized()).toRotationMatrix();
}

// Not symmetric, far from singular.
Matrix6 Mixed() {
  Matrix6 mixed = 3.0 * Matrix6::Identity();
  for (int i = 0; i < 36; ++i) mixed(i / 6, i % 6) += std::sin(1.0 + 5.0 * i);
  return mixed;
}

TEST(Decompositions, SolutionsAndInversesOfSix) {
  const Matrix6 mixed = Mixed();
  const Matrix6 N = mixed.transpose() * mixed;
  const Vector6 x = Vector6::LinSpaced(-2.0, 3.0);
  EXPECT_LT((SolveSymmetric(N, N * x) - x).norm(), kTolerance);
  EXPECT_LT((InverseOf(mixed) * mixed - Matrix6::Identity()).norm(), kTolerance);
  ASSERT_TRUE(InverseOfPositive(N));
  EXPECT_LT((*InverseOfPositive(N) * N - Matrix6::Identity()).norm(), kTolerance);
}

TEST(Decompositions, ANegativeEigenvalueHasNoInverseOfPositive) {
  const Matrix6 mixed = Mixed();
  Vector6 values = Vector6::Ones();
  values[3] = -0.1;
  const Matrix6 N = mixed.transpose() * values.asDiagonal() * mixed;
  EXPECT_FALSE(InverseOfPositive(N));
  EXPECT_LT((SolveSymmetric(N, N * values) - values).norm(), 1e-10) << "but a solution";
}

TEST(Decompositions, TheLargestEigenvalueIsNotTheFarthestFromZero) {
  const Eigen::Matrix3d R = Turn(1.0, 2.0, 3.0);
  const Eigen::Vector3d values(1.0, 3.0, -5.0);
  EXPECT_NEAR(LargestEigenvalue(R * values.asDiagonal() * R.transpose()), 3.0, kTolerance);
}

TEST(Decompositions, SingularValuesAreThoseThatWerePutIn) {
  const Eigen::Vector3d values(0.5, 4.0, 2.0);
  const Eigen::Matrix3d matrix =
      Turn(1.0, 2.0, 3.0) * values.asDiagonal() * Turn(-2.0, 0.0, 1.0).transpose();
  const SingularValues found = SingularValuesOf(matrix);
  EXPECT_LT((found.values - Eigen::Vector3d(4.0, 2.0, 0.5)).norm(), kTolerance);
  EXPECT_LT((found.U * found.values.asDiagonal() * found.V.transpose() - matrix).norm(),
            kTolerance);
  EXPECT_LT((found.U.transpose() * found.U - Eigen::Matrix3d::Identity()).norm(), kTolerance);
  EXPECT_LT((found.V.transpose() * found.V - Eigen::Matrix3d::Identity()).norm(), kTolerance);
}

}  // namespace
}  // namespace rockyard::math
