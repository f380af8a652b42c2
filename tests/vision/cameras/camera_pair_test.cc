// Pairs of cameras: points from disparities, which pairs need no rectification, and pairs that
// drift.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/archive.h"
#include "core/error.h"
#include "core/numbers.h"
#include "vision/cameras/rectification.h"
#include "vision/cameras/rig_drift.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

// Points from disparities, and their covariance; which pairs of cameras need no rectification.

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

// A drifted rig against closed forms of aligned cameras, and what is drawn of it.

constexpr double kFocal_px = 400.0;
constexpr double kBaseline_m = 0.2;
constexpr ImageSize kDriftSize{641, 481};

// Aligned cameras told in a frame of no special direction.
CameraModel Aligned(double x_m) {
  const Cahv camera{{x_m, 0, 0}, {0, 0, 1}, {kFocal_px, 0, 320}, {0, kFocal_px, 240}};
  return Moved(TestPose(), CameraModel{camera, kDriftSize});
}

// Column and row of a point of the aligned cameras' frame, before and after the drift.
struct Change {
  Pixel before;
  Pixel after;
};

Change ChangeOf(const RigDrift& drift, const Vector3& p) {
  const CameraModel right = Aligned(kBaseline_m);
  const Vector3 p_A = TestPose() * p;
  return {*Project(right, p_A), *Project(DriftedRight(Aligned(0.0), right, drift), p_A)};
}

// Slopes of points as the right camera sees them.
const Vector3 kCentre(kBaseline_m, 0, 0);
const Vector3 kAhead = kCentre + Vector3(0, 0, 5);
const Vector3 kAside = kCentre + Vector3(1.5, 1, 5);

TEST(RigDriftTest, ToeInMovesColumnsByTheTangent) {
  const double yaw_rad = 0.003;
  const Change ahead = ChangeOf({.yaw_rad = yaw_rad}, kAhead);
  EXPECT_NEAR(ahead.after.x() - ahead.before.x(), kFocal_px * std::tan(yaw_rad), 1e-9);
  EXPECT_NEAR(ahead.after.y(), ahead.before.y(), 1e-9);
  const Change aside = ChangeOf({.yaw_rad = yaw_rad}, kCentre + Vector3(1.5, 0, 5));
  EXPECT_NEAR(aside.after.x() - 320.0, kFocal_px * std::tan(std::atan(0.3) + yaw_rad), 1e-9);
}

// A rover that goes by the old calibration sees a far point, turned in by yaw, at
// Z' = f B / (f B / Z - f yaw): farther, by Z^2 yaw / B to first order.
TEST(RigDriftTest, ToeInMakesRangesLonger) {
  const CameraModel left = Aligned(0.0);
  const CameraModel right = Aligned(kBaseline_m);
  const double yaw_rad = 0.002;
  const Vector3 p_A = TestPose() * kAhead;
  const Pixel in_left = *Project(left, p_A);
  const Pixel in_right = *Project(DriftedRight(left, right, {.yaw_rad = yaw_rad}), p_A);
  const auto believed = Triangulate(std::get<Cahv>(left.lens), std::get<Cahv>(right.lens), in_left,
                                    in_left.x() - in_right.x());
  ASSERT_TRUE(believed.has_value());
  const double disparity_px = kFocal_px * (kBaseline_m / 5.0 - std::tan(yaw_rad));
  EXPECT_NEAR((TestPose().inverse() * believed->p_A).z(), kFocal_px * kBaseline_m / disparity_px,
              1e-9);
}

TEST(RigDriftTest, PitchMovesRowsUpWhereTheCameraLooksDown) {
  const Change ahead = ChangeOf({.pitch_rad = 0.004}, kAhead);
  EXPECT_NEAR(ahead.after.y() - ahead.before.y(), -kFocal_px * std::tan(0.004), 1e-9);
  EXPECT_NEAR(ahead.after.x(), ahead.before.x(), 1e-9);
}

TEST(RigDriftTest, RollTurnsTheImageTheOtherWay) {
  const double roll_rad = 0.01;
  const Change aside = ChangeOf({.roll_rad = roll_rad}, kAside);
  const Pixel before = aside.before - Pixel(320, 240);
  const Pixel turned = Eigen::Rotation2Dd(-roll_rad) * before;
  EXPECT_LT((aside.after - Pixel(320, 240) - turned).norm(), 1e-9);
}

TEST(RigDriftTest, BaselineAndFocalLengthChangeDisparities) {
  const Change apart = ChangeOf({.baseline_m = 0.01}, kAhead);
  EXPECT_NEAR(apart.after.x() - apart.before.x(), -kFocal_px * 0.01 / 5.0, 1e-9);
  const Change longer = ChangeOf({.focal_share = 0.01}, kAside);
  EXPECT_LT((longer.after - Pixel(320, 240) - 1.01 * (longer.before - Pixel(320, 240))).norm(),
            1e-9);
}

// All at once, against the first-order formula of the header: its error is of second order.
TEST(RigDriftTest, SmallDriftsAddUp) {
  const double yaw = 1e-4;
  const double pitch = -2e-4;
  const double roll = 3e-4;
  const Change aside = ChangeOf({.roll_rad = roll, .pitch_rad = pitch, .yaw_rad = yaw}, kAside);
  const double a = 0.3;
  const double b = 0.2;
  const Pixel change = aside.after - aside.before;
  EXPECT_NEAR(change.x(), kFocal_px * (yaw * (1 + a * a) + pitch * -a * b + roll * b), 1e-4);
  EXPECT_NEAR(change.y(), kFocal_px * (yaw * a * b - pitch * (1 + b * b) - roll * a), 1e-4);
}

TEST(RigDriftTest, WithoutDriftTheCameraIsTheSameBitForBit) {
  for (const NamedCamera& named : ModelCameras()) {
    const CameraModel left = Moved(math::MakePose({1, 0, 0}, 0, 0, 0), named.camera);
    const CameraModel right = DriftedRight(left, named.camera, {});
    const Vector3 p_A = TestPose() * Vector3(0.1, 0.2, 3.0);
    const auto before = Project(named.camera, p_A);
    EXPECT_EQ(Project(right, p_A), before) << named.name;
    const CameraModel drifted = DriftedRight(left, named.camera, {.yaw_rad = 1e-3});
    EXPECT_NE(Project(drifted, p_A), before) << named.name;
  }
}

using Member = std::function<double(const RigDrift&)>;

// Sums of squares over deviation squared: chi-squared, two-sided at alpha = 0.001 each.
TEST(RigDriftTest, DrawsHaveTheirDeviations) {
  const RigDriftParams params{1e-3, 2e-3, 3e-3, 4e-4, 0.5};
  const std::vector<std::pair<Member, double>> members = {
      {[](const RigDrift& drift) { return drift.roll_rad; }, 1e-3},
      {[](const RigDrift& drift) { return drift.pitch_rad; }, 2e-3},
      {[](const RigDrift& drift) { return drift.yaw_rad; }, 3e-3},
      {[](const RigDrift& drift) { return drift.baseline_m; }, 4e-4},
      {[](const RigDrift& drift) { return drift.focal_share; }, 5e-3}};
  constexpr int kDraws = 4000;
  const boost::math::chi_squared chi_squared(kDraws);
  const double low = quantile(chi_squared, 0.0005);
  const double high = quantile(chi_squared, 0.9995);
  core::RandomStream stream({232, 0}, core::Purpose::kTest);
  std::vector<RigDrift> drifts(kDraws);
  for (RigDrift& drift : drifts) drift = DrawRigDrift(params, stream);
  for (const auto& [value, sd] : members) {
    double sum = 0.0;
    for (const RigDrift& drift : drifts) sum += value(drift) * value(drift);
    EXPECT_GT(sum / (sd * sd), low);
    EXPECT_LT(sum / (sd * sd), high);
    // The control: a deviation that is 10 % off is found.
    EXPECT_GT(sum / (0.9 * 0.9 * sd * sd), high);
  }
}

TEST(RigDriftTest, ADeviationOfZeroLeavesTheOtherDraws) {
  core::RandomStream all_stream({233, 0}, core::Purpose::kTest);
  core::RandomStream some_stream({233, 0}, core::Purpose::kTest);
  const RigDrift all = DrawRigDrift({1e-3, 1e-3, 1e-3, 1e-3, 1.0}, all_stream);
  const RigDrift some = DrawRigDrift({0.0, 1e-3, 0.0, 1e-3, 1.0}, some_stream);
  EXPECT_EQ(some, (RigDrift{0.0, all.pitch_rad, 0.0, all.baseline_m, all.focal_share}));
}

TEST(RigDriftTest, FilesHaveDegreesAndRefuseNegativeDeviations) {
  RigDriftParams params;
  core::JsonValue json = core::WriteParams(params);
  json.Set("yaw_sd_deg", core::JsonValue(0.05));
  core::ReadParams(json, params);
  EXPECT_NEAR(params.yaw_sd_rad, 0.05 * std::numbers::pi / 180.0, 1e-15);
  json.Set("baseline_sd_m", core::JsonValue(-1e-3));
  EXPECT_THROW(core::ReadParams(json, params), core::UserError);
}

}  // namespace
}  // namespace rockyard::vision
