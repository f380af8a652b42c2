// Visual odometry on images of a known world: motions, keyframes, and reasons for none.
#include "vision/odometry/odometer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "vision/odometry/plain_motion.h"
#include "vision/odometry/synthetic_sequence.h"

namespace rockyard::vision {
namespace {

using math::Transform;

constexpr ImageSize kSize{256, 192};

const RectifiedPair& Cameras() {
  static const RectifiedPair cameras = PlanePair(kSize);
  return cameras;
}

AlignedImages See(const Transform& X_WR, std::uint32_t moment = 0) {
  return SeePlane(Cameras(), X_WR, {}, moment);
}

Transform Ahead(double way_m, double turn_rad = 0.0) {
  return math::MakePose({way_m, 0.0, 0.0}, turn_rad, 0.0, 0.0);
}

VisualOdometer Odometer(const OdometerParams& params = {}) {
  return VisualOdometer(params, Cameras(), {}, {25, 1});
}

// One that has seen its first pair.
VisualOdometer Started(const OdometerParams& params = {}) {
  VisualOdometer odometer = Odometer(params);
  odometer.Add(See(Transform::Identity(), 0));
  return odometer;
}

void ExpectNear(const OdometryStep& step, const Transform& truth, double limit_m,
                double limit_rad) {
  ASSERT_TRUE(step.result.motion) << static_cast<int>(*step.result.reason);
  const auto error = ErrorOf(step.result.motion->X_FS, truth);
  EXPECT_LT(error.head<3>().norm(), limit_m);
  EXPECT_LT(error.tail<3>().norm(), limit_rad);
}

TEST(VisualOdometerTest, FindsHowTheCamerasMoved) {
  VisualOdometer odometer = Odometer();
  const OdometryStep first = odometer.Add(See(Transform::Identity(), 0));
  EXPECT_EQ(first.number, 0);
  EXPECT_TRUE(first.keyframe);
  EXPECT_FALSE(first.result.motion);
  EXPECT_FALSE(first.result.reason);
  const Transform moved = math::MakePose({0.12, 0.02, 0.01}, 0.05, 0.01, -0.02);
  const OdometryStep step = odometer.Add(See(moved, 1));
  ExpectNear(step, moved, 0.006, 0.003);
  EXPECT_EQ(step.number, 1);
  EXPECT_EQ(step.reference, 0);
  EXPECT_FALSE(step.keyframe);
  const MotionCounts& counts = step.result.counts;
  EXPECT_EQ(counts.features_second, static_cast<std::int64_t>(step.features.size()));
  EXPECT_EQ(counts.consistent, static_cast<std::int64_t>(step.consistent.size()));
  EXPECT_GE(counts.matches, counts.points);
  EXPECT_GE(counts.points, counts.consistent);
}

// 40 cm and 12 deg are more than windows bear unless they are warped by a motion.
TEST(VisualOdometerTest, LargeStepsAreFoundInTwoRoundsAndByPrediction) {
  const Transform moved = Ahead(0.4, 0.2);
  const OdometryStep twice = Started().Add(See(moved, 1));
  ExpectNear(twice, moved, 0.015, 0.006);
  OdometerParams once;
  once.rounds = 1;
  VisualOdometer plain = Started(once);
  EXPECT_LT(plain.Add(See(moved, 1)).result.counts.consistent, twice.result.counts.consistent);
  const OdometryStep step = Started(once).Add(See(moved, 1), Ahead(0.36, 0.17));
  ExpectNear(step, moved, 0.015, 0.006);
}

// How often features are matched where the camera goes 20 cm and turns by 4 deg.
int RoundsOf(const OdometerParams& params, const std::optional<Transform>& predicted) {
  int matched = 0;
  VisualOdometer odometer(params, Cameras(), {}, {25, 1}, [&](OdometryStage stage) {
    matched += stage == OdometryStage::kMatched ? 1 : 0;
  });
  odometer.Add(See(Transform::Identity(), 0));
  const Transform moved = Ahead(0.2, math::DegToRad(4.0));
  ExpectNear(odometer.Add(See(moved, 1), predicted), moved, 0.01, 0.004);
  return matched;
}

TEST(VisualOdometerTest, MatchesAnewWhereAnotherMotionWasPredicted) {
  OdometerParams params;
  EXPECT_EQ(RoundsOf(params, std::nullopt), 2);
  const Transform shorter = Ahead(0.15, math::DegToRad(4.0));
  EXPECT_EQ(RoundsOf(params, shorter), 1);
  params.round_way_m = 0.02;
  EXPECT_EQ(RoundsOf(params, shorter), 2);
  params.round_way_m = 0.1;
  const Transform straighter = Ahead(0.2, math::DegToRad(2.0));
  EXPECT_EQ(RoundsOf(params, straighter), 1);
  params.round_turn_rad = math::DegToRad(1.0);
  EXPECT_EQ(RoundsOf(params, straighter), 2);
}

// Windows of 9 pixels have a third of the texture of those of 15: what is known of the way, of
// which nothing else is told, is less.
TEST(VisualOdometerTest, SmallWindowsKnowLess) {
  const auto covariance = [](std::int64_t window_px) {
    OdometerParams params;
    params.placement.window_px = window_px;
    params.placement.noise_px = 0.001;
    const OdometryStep step = Started(params).Add(See(Ahead(0.1), 1), Ahead(0.1));
    EXPECT_TRUE(step.result.motion);
    return step.result.motion.value_or(Motion{}).covariance;
  };
  EXPECT_GT(covariance(9)(0, 0), 1.4 * covariance(15)(0, 0));
}

TEST(VisualOdometerTest, AStillCameraStaysWhereItIs) {
  VisualOdometer odometer = Started();
  for (std::uint32_t moment = 1; moment < 8; ++moment) {
    const OdometryStep step = odometer.Add(See(Transform::Identity(), moment));
    ExpectNear(step, Transform::Identity(), 0.003, 0.0015);
    EXPECT_EQ(step.reference, 0);
    EXPECT_FALSE(step.keyframe);
  }
}

// Steps of 4 cm and 1 deg.
Transform AfterSteps(int steps) { return Ahead(0.04 * steps, math::DegToRad(1.0) * steps); }

// Which pairs become keyframes.
std::string Keyframes(const std::vector<AlignedImages>& images, const KeyframeParams& rule) {
  OdometerParams params;
  params.keyframe = rule;
  VisualOdometer odometer = Odometer(params);
  std::string keyframes;
  for (const AlignedImages& pair : images) {
    const OdometryStep step = odometer.Add(pair);
    EXPECT_EQ(step.number > 0, step.result.motion.has_value()) << step.number;
    keyframes += step.keyframe ? 'K' : '.';
  }
  return keyframes;
}

TEST(VisualOdometerTest, KeyframesAreRenewedByWayByTurnAndByShare) {
  std::vector<AlignedImages> images;
  for (int i = 0; i < 6; ++i) images.push_back(See(AfterSteps(i), static_cast<std::uint32_t>(i)));
  EXPECT_EQ(Keyframes(images, {.max_way_m = 10.0, .max_turn_rad = 3.0, .min_share = 0.0}),
            "K.....");
  EXPECT_EQ(Keyframes(images, {.max_way_m = 0.1, .max_turn_rad = 3.0, .min_share = 0.0}), "K..K..");
  EXPECT_EQ(
      Keyframes(images, {.max_way_m = 10.0, .max_turn_rad = math::DegToRad(1.5), .min_share = 0.0}),
      "K.K.K.");
  EXPECT_EQ(Keyframes(images, {.max_way_m = 10.0, .max_turn_rad = 3.0, .min_share = 1.0}),
            "KKKKKK");
  EXPECT_EQ(Keyframes(images, {.max_way_m = 0.0, .max_turn_rad = 3.0, .min_share = 0.0}), "KKKKKK");
}

// A dark pair: by default it takes the keyframe's place and the path has two gaps; where two
// failures are borne, the next pair is compared with the one before it.
TEST(VisualOdometerTest, AFailedPairTakesTheKeyframesPlaceAfterSoMany) {
  const AlignedImages dark{GrayImage(kSize.columns, kSize.rows, 3),
                           GrayImage(kSize.columns, kSize.rows, 3)};
  VisualOdometer odometer = Started();
  const OdometryStep failed = odometer.Add(dark);
  EXPECT_EQ(failed.result.reason, NoMotion::kFewFeatures);
  EXPECT_TRUE(failed.keyframe);
  const OdometryStep after = odometer.Add(See(Ahead(0.05), 2));
  EXPECT_EQ(after.result.reason, NoMotion::kFewFeatures);
  EXPECT_EQ(after.reference, 1);

  OdometerParams params;
  params.keyframe.failures = 2;
  VisualOdometer patient = Started(params);
  EXPECT_FALSE(patient.Add(dark).keyframe);
  const OdometryStep found = patient.Add(See(Ahead(0.05), 2));
  EXPECT_EQ(found.reference, 0);
  ExpectNear(found, Ahead(0.05), 0.006, 0.003);
  EXPECT_FALSE(patient.Add(dark).keyframe);
  EXPECT_TRUE(patient.Add(dark).keyframe);
}

TEST(VisualOdometerTest, RenewBeginsANewPath) {
  VisualOdometer odometer = Started();
  odometer.Renew();
  const OdometryStep first = odometer.Add(See(Ahead(2.0), 1));
  EXPECT_EQ(first.number, 1);
  EXPECT_EQ(first.reference, 1);
  EXPECT_TRUE(first.keyframe);
  EXPECT_FALSE(first.result.reason);
  ExpectNear(odometer.Add(See(Ahead(2.05), 2)), Ahead(0.05), 0.006, 0.003);
}

// Another place altogether: nothing looks alike, or nothing moved as one.
TEST(VisualOdometerTest, AnotherPlaceIsNoMotion) {
  const OdometryStep step = Started().Add(See(Ahead(40.0), 1));
  EXPECT_FALSE(step.result.motion);
  EXPECT_TRUE(step.result.reason == NoMotion::kFewMatches ||
              step.result.reason == NoMotion::kFewPoints ||
              step.result.reason == NoMotion::kNoConsistentSet)
      << static_cast<int>(*step.result.reason);
}

// A share of the points that is large enough, but one point fewer than are asked for.
TEST(VisualOdometerTest, FewerConsistentPointsThanAskedForAreNoMotion) {
  const auto result = [](const OdometerParams& params) {
    return Started(params).Add(See(Ahead(0.1), 1)).result;
  };
  OdometerParams params;
  const MotionCounts counts = result(params).counts;
  ASSERT_GT(counts.points, counts.consistent);
  params.selection.min_consistent = static_cast<int>(counts.consistent);
  EXPECT_TRUE(result(params).motion);
  params.selection.min_consistent = static_cast<int>(counts.consistent) + 1;
  const MotionResult few = result(params);
  EXPECT_EQ(few.counts.consistent, counts.consistent);
  EXPECT_FALSE(few.motion);
  EXPECT_EQ(few.reason, NoMotion::kNoConsistentSet);
}

// The lower part of what is seen moved otherwise: one of both motions, or none, and no mixture.
TEST(VisualOdometerTest, OfTwoMotionsInOneImageOneIsFoundOrNone) {
  const Transform of_upper = Ahead(0.02);
  const Transform of_lower = Ahead(0.10, 0.03);
  const AlignedImages before = See(Transform::Identity(), 0);
  const AlignedImages upper = See(of_upper, 1);
  const AlignedImages lower = See(of_lower, 2);
  int found = 0;
  for (const int border : {48, 72, 96, 120, 144}) {
    AlignedImages images = upper;
    for (int y = border; y < kSize.rows; ++y) {
      std::copy(lower.left.Row(y).begin(), lower.left.Row(y).end(), images.left.Row(y).begin());
      std::copy(lower.right.Row(y).begin(), lower.right.Row(y).end(), images.right.Row(y).begin());
    }
    VisualOdometer odometer = Odometer();
    odometer.Add(before);
    const OdometryStep step = odometer.Add(images);
    if (!step.result.motion) continue;
    ++found;
    const auto off_m = [&](const Transform& truth) {
      return ErrorOf(step.result.motion->X_FS, truth).head<3>().norm();
    };
    EXPECT_LT(std::min(off_m(of_upper), off_m(of_lower)), 0.012) << border;
  }
  EXPECT_GE(found, 3);
}

TEST(VisualOdometerTest, TheMaskHidesFeatures) {
  Image<std::uint8_t> free(kSize.columns, kSize.rows, 1);
  for (int y = 100; y < kSize.rows; ++y) std::fill(free.Row(y).begin(), free.Row(y).end(), 0);
  VisualOdometer odometer({}, Cameras(), free, {25, 1});
  const OdometryStep step = odometer.Add(See(Transform::Identity()));
  ASSERT_GT(step.features.size(), 30u);
  for (const Feature& feature : step.features) EXPECT_LT(feature.row, 100);
}

TEST(VisualOdometerTest, StepsAreTheSameForTheSameKeyWhoeverWatches) {
  std::vector<OdometryStage> stages;
  VisualOdometer watched({}, Cameras(), {}, {25, 1},
                         [&](OdometryStage stage) { stages.push_back(stage); });
  VisualOdometer alone = Odometer();
  const Transform predicted = Ahead(0.06);
  for (int i = 0; i < 2; ++i) {
    const AlignedImages images = See(Ahead(0.06 * i), static_cast<std::uint32_t>(i));
    const OdometryStep a = watched.Add(images, predicted);
    const OdometryStep b = alone.Add(images, predicted);
    ASSERT_EQ(a.result.motion.has_value(), b.result.motion.has_value());
    if (!a.result.motion) continue;
    EXPECT_EQ(a.result.motion->X_FS.matrix(), b.result.motion->X_FS.matrix());
    EXPECT_EQ(a.result.motion->covariance, b.result.motion->covariance);
  }
  using enum OdometryStage;
  EXPECT_EQ(stages, (std::vector{kDetected, kRenewed, kDetected, kMatched, kPlaced, kSelected,
                                 kEstimated, kRenewed}));
}

}  // namespace
}  // namespace rockyard::vision
