// A drifted rig against closed forms of aligned cameras, and what is drawn of it.
#include "vision/cameras/rig_drift.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/archive.h"
#include "core/error.h"
#include "vision/cameras/rectification.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

constexpr double kFocal_px = 400.0;
constexpr double kBaseline_m = 0.2;
constexpr ImageSize kSize{641, 481};

// Aligned cameras told in a frame of no special direction.
CameraModel Aligned(double x_m) {
  const Cahv camera{{x_m, 0, 0}, {0, 0, 1}, {kFocal_px, 0, 320}, {0, kFocal_px, 240}};
  return Moved(TestPose(), CameraModel{camera, kSize});
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
