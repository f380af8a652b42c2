// Points from disparities, and their covariance; which pairs of cameras need no rectification.
#include <gtest/gtest.h>

#include <functional>

#include "core/numbers.h"
#include "vision/cameras/rectification.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

RectifiedPair TestPair() {
  const math::Transform X_AC = TestPose();
  const Cahv left = Moved(X_AC, Cahv{{0, 0, 0}, {0, 0, 1}, {400, 0, 200}, {0, 400, 150}});
  Cahv right = left;
  right.C = X_AC * Vector3(0.12, 0, 0);
  return {left, right, {401, 301}, 400.0, 0.12};
}

TEST(TriangulationTest, FindsThePointThatBothCamerasSee) {
  const RectifiedPair pair = TestPair();
  for (const Vector3& p_C : {Vector3(0.3, -0.2, 1.0), Vector3(-2.0, 1.0, 9.0), Vector3(0, 0, 60)}) {
    const Vector3 p_A = TestPose() * p_C;
    const auto in_left = Project(pair.left, p_A);
    const auto in_right = Project(pair.right, p_A);
    ASSERT_TRUE(in_left && in_right);
    EXPECT_NEAR(in_left->y(), in_right->y(), 1e-10);
    const double disparity_px = in_left->x() - in_right->x();
    EXPECT_NEAR(disparity_px, 400.0 * 0.12 / p_C.z(), 1e-10);
    const auto point = Triangulate(pair.left, pair.right, *in_left, disparity_px);
    ASSERT_TRUE(point);
    EXPECT_LT((point->p_A - p_A).norm(), 1e-8);
  }
}

// Matthies and Shafer 1987: dr = r^2 dd / (f B), and r / f across.
TEST(TriangulationTest, TheRangeErrorGrowsWithTheSquareOfTheRange) {
  const RectifiedPair pair = TestPair();
  const double sigma_d_px = 0.3;
  const double sigma_px = 0.2;
  const Eigen::Vector3d variances(sigma_px * sigma_px, sigma_px * sigma_px,
                                  sigma_d_px * sigma_d_px);
  const Eigen::Matrix3d measured = variances.asDiagonal();
  for (const double range_m : {1.0, 4.0, 20.0}) {
    // On the axis, where the range is the depth.
    const auto point = Triangulate(pair.left, pair.right, {200, 150}, 400.0 * 0.12 / range_m);
    ASSERT_TRUE(point);
    const Eigen::Matrix3d in_A = point->Covariance(measured);
    const Eigen::Matrix3d R_AC = TestPose().linear();
    const Eigen::Matrix3d in_C = R_AC.transpose() * in_A * R_AC;
    EXPECT_NEAR(std::sqrt(in_C(2, 2)), range_m * range_m * sigma_d_px / (400.0 * 0.12),
                1e-9 * range_m * range_m);
    EXPECT_NEAR(std::sqrt(in_C(0, 0)), range_m * sigma_px / 400.0, 1e-9);
    EXPECT_NEAR(std::sqrt(in_C(1, 1)), range_m * sigma_px / 400.0, 1e-9);
    EXPECT_NEAR(in_C(0, 2), 0.0, 1e-9);
  }
}

TEST(TriangulationTest, DerivativesAreCentralDifferences) {
  const RectifiedPair pair = TestPair();
  const Eigen::Vector3d measured(90.0, 250.0, 14.0);
  const auto at = [&](const Eigen::Vector3d& m) {
    return Triangulate(pair.left, pair.right, m.head<2>(), m.z())->p_A;
  };
  const auto point = Triangulate(pair.left, pair.right, measured.head<2>(), measured.z());
  ASSERT_TRUE(point);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = 1e-4 * Eigen::Vector3d::Unit(i);
    const Vector3 slope = (at(measured + step) - at(measured - step)) / 2e-4;
    EXPECT_LT((point->by_measurement.col(i) - slope).norm(), 1e-8);
  }
}

TEST(TriangulationTest, NothingAtOrBeyondInfinity) {
  const RectifiedPair pair = TestPair();
  for (const double disparity_px : {0.0, -1.0, core::kNaN, 1e-320, 1e-160}) {
    EXPECT_FALSE(Triangulate(pair.left, pair.right, {10, 10}, disparity_px)) << disparity_px;
  }
  EXPECT_FALSE(Triangulate(pair.left, pair.right, {core::kNaN, 10}, 5.0));
}

constexpr ImageSize kSize{64, 48};

// Looks along x, y to the left; pixels 1.25 times as wide as they are high.
Cahv LinearAt(double y_m) {
  const math::Vector3 axis(1.0, 0.0, 0.0);
  return {{0.1, y_m, 0.5},
          axis,
          math::Vector3(0.0, -40.0, 0.0) + 31.5 * axis,
          math::Vector3(0.0, 0.0, -50.0) + 23.5 * axis};
}

TEST(AlignedPairTest, AlignedLinearCamerasStayAsTheyAre) {
  const auto pair = AlignedPair({LinearAt(0.06), kSize}, {LinearAt(-0.06), kSize});
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->left, LinearAt(0.06));
  EXPECT_EQ(pair->right, LinearAt(-0.06));
  EXPECT_EQ(pair->size, kSize);
  EXPECT_DOUBLE_EQ(pair->focal_px, 40.0);
  EXPECT_DOUBLE_EQ(pair->baseline_m, 0.12);
  // A point 2 m away has the disparity f b / Z = 40 * 0.12 / 2, in the same row.
  const math::Vector3 p(2.1, 0.3, 0.2);
  const Pixel left = *Project(pair->left, p);
  const Pixel right = *Project(pair->right, p);
  EXPECT_NEAR(left.x() - right.x(), pair->focal_px * pair->baseline_m / 2.0, 1e-12);
  EXPECT_NEAR(left.y(), right.y(), 1e-12);
}

TEST(AlignedPairTest, WhateverBreaksTheRowsIsNotAligned) {
  const CameraModel left{LinearAt(0.06), kSize};
  const std::function<void(Cahv&)> faults[] = {
      [](Cahv& c) { c.A = math::Vector3(1.0, 1e-6, 0.0).normalized(); },
      [](Cahv& c) { c.H.y() -= 1e-6; },
      [](Cahv& c) { c.V.x() += 1e-6; },
      [](Cahv& c) { c.C.z() += 1e-8; },  // baseline up the columns
      [](Cahv& c) { c.C.x() += 1e-8; },  // along the axis
      [](Cahv& c) { c.C.y() = 0.06; },   // no baseline
      [](Cahv& c) { c.C.y() = 0.18; },   // eyes swapped
  };
  for (const auto& fault : faults) {
    Cahv right = LinearAt(-0.06);
    fault(right);
    EXPECT_FALSE(AlignedPair(left, {right, kSize}));
  }
  EXPECT_FALSE(AlignedPair(left, {LinearAt(-0.06), {64, 50}}));
  EXPECT_FALSE(AlignedPair(left, {BrownPinhole{}, kSize}));
  EXPECT_FALSE(AlignedPair({BrownPinhole{}, kSize}, {LinearAt(-0.06), kSize}));
}

}  // namespace
}  // namespace rockyard::vision
