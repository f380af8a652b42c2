// Derivatives by a camera's numbers against central differences of Project.
#include <gtest/gtest.h>

#include "vision/calibration/bundle.h"
#include "vision/calibration/rendered_target.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

Cahvor TurnedCahvor() { return Moved(TestPose(), TestCahvor()); }

TEST(CameraParametersTest, NumbersAreThoseOfTheCamera) {
  const Cahvor camera = TurnedCahvor();
  EXPECT_EQ(CameraOfNumbers(NumbersOf(camera)), camera);
  EXPECT_EQ(NumbersOf(camera)[kBlockH + 2], camera.linear.H.z());
  EXPECT_EQ(NumbersOf(camera)[kBlockR + 1], camera.R[1]);
}

TEST(CameraParametersTest, DerivativesAreThoseOfProject) {
  const Cahvor camera = TurnedCahvor();
  for (const Vector3& p : {Vector3(0.3, -0.2, 0.8), Vector3(-0.5, 0.4, 1.1), Vector3(0, 0.1, 2)}) {
    const Vector3 p_A = TestPose() * p;
    NumbersJacobian by_numbers;
    PixelJacobian by_point;
    const auto pixel = ProjectByNumbers(camera, p_A, by_numbers, by_point);
    ASSERT_TRUE(pixel.has_value());
    EXPECT_EQ(*pixel, *Project(camera, p_A));
    const auto basis = TangentBasis(camera, EstimatedLens::kCahvor, EstimatedPlace::kFree);
    for (Eigen::Index i = 0; i < basis.cols(); ++i) {
      const CameraVector step = 1e-6 * basis.col(i);
      const auto more = Project(CameraOfNumbers(NumbersOf(camera) + step), p_A);
      const auto less = Project(CameraOfNumbers(NumbersOf(camera) - step), p_A);
      const Pixel slope = (*more - *less) / 2e-6;
      EXPECT_LT((by_numbers * basis.col(i) - slope).norm(), 1e-5 * (1.0 + slope.norm())) << i;
    }
    // R0, which is not estimated.
    const CameraVector step = 1e-6 * CameraVector::Unit(kBlockR);
    const auto more = Project(CameraOfNumbers(NumbersOf(camera) + step), p_A);
    EXPECT_LT((by_numbers.col(kBlockR) - (*more - *pixel) / 1e-6).norm(), 1e-3);
  }
}

TEST(CameraParametersTest, TheBasisKeepsLengthsAndWhatStandsStill) {
  const auto count = [](const Cahvor& camera, EstimatedLens lens, EstimatedPlace place) {
    return TangentBasis(camera, lens, place).cols();
  };
  const Cahvor camera = TestCahvor();
  EXPECT_EQ(count(camera, EstimatedLens::kCahv, EstimatedPlace::kOrigin), 5);
  EXPECT_EQ(count(camera, EstimatedLens::kCahvor, EstimatedPlace::kOrigin), 9);
  EXPECT_EQ(count(camera, EstimatedLens::kCahv, EstimatedPlace::kFree), 11);
  EXPECT_EQ(count(camera, EstimatedLens::kCahvor, EstimatedPlace::kFree), 15);
  const Cahvor turned = TurnedCahvor();
  const auto basis = TangentBasis(turned, EstimatedLens::kCahvor, EstimatedPlace::kFree);
  EXPECT_LT((turned.linear.A.transpose() * basis.middleRows<3>(kBlockA)).norm(), 1e-12);
  EXPECT_LT((turned.O.transpose() * basis.middleRows<3>(kBlockO)).norm(), 1e-12);
  EXPECT_EQ(basis.row(kBlockR).norm(), 0.0);
  // Columns are of unit length and across each other: nothing is counted twice.
  EXPECT_LT((basis.transpose() * basis - Eigen::MatrixXd::Identity(15, 15)).norm(), 1e-12);
  const auto still = TangentBasis(camera, EstimatedLens::kCahvor, EstimatedPlace::kOrigin);
  EXPECT_EQ(still.topRows<6>().norm() + still.row(kBlockH + 1).norm(), 0.0);
}

TEST(CameraParametersTest, AStepEndsAtUnitLengths) {
  const CameraVector change = CameraVector::Constant(0.05);
  const Cahvor bent = Stepped(TurnedCahvor(), change, EstimatedLens::kCahvor);
  EXPECT_NEAR(bent.linear.A.norm(), 1.0, 1e-12);
  EXPECT_NEAR(bent.O.norm(), 1.0, 1e-12);
  EXPECT_NE(bent.O, bent.linear.A);
  const Cahvor linear = Stepped(TurnedCahvor(), change, EstimatedLens::kCahv);
  EXPECT_EQ(linear.O, linear.linear.A);
}

}  // namespace
}  // namespace rockyard::vision
