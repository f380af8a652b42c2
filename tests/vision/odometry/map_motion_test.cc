// Motions whose points have their places from a disparity map, beside those from the right eye, on
// images of a plane.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/check.h"
#include "core/random.h"
#include "vision/odometry/odometer.h"
#include "vision/odometry/place_features.h"
#include "vision/odometry/synthetic_sequence.h"
#include "vision/odometry/trajectory_error.h"

namespace rockyard::vision {
namespace {

using math::Transform;

constexpr ImageSize kSize{256, 192};
constexpr int kSteps = 24;

struct KnownStep {
  AlignedImages first;
  AlignedImages second;
  Transform X_FS;
};

// Steps of 5 to 25 cm with turns up to 5 deg, each over a texture of its own.
const std::vector<KnownStep>& KnownSteps() {
  static const std::vector<KnownStep> steps = [] {
    std::vector<KnownStep> made;
    core::RandomStream stream({259, 0}, core::Purpose::kTest, 0);
    for (std::uint32_t i = 0; i < kSteps; ++i) {
      const Transform X_FS = math::MakePose(
          {core::SampleUniform(stream, 0.05, 0.25), core::SampleUniform(stream, -0.02, 0.02), 0.0},
          core::SampleUniform(stream, -0.09, 0.09), 0.01, -0.01);
      const RectifiedPair pair = PlanePair(kSize);
      const PlaneWorld world{.number = 100 + i};
      made.push_back(
          {SeePlane(pair, Transform::Identity(), world, 0), SeePlane(pair, X_FS, world, 1), X_FS});
    }
    return made;
  }();
  return steps;
}

OdometerParams ParamsOf(PlaceSource source) {
  OdometerParams params;
  params.placement.source = source;
  return params;
}

// What the motions of all steps add up to.
struct Sums {
  int found = 0;
  double nees = 0.0;          // e' P^-1 e
  double nees_control = 0.0;  // of a quarter of P
  double squares_m2 = 0.0;
};

// `prepare` makes a pair of images what the odometer is given.
template <typename Prepare>
Sums SumsOf(PlaceSource source, const Prepare& prepare) {
  Sums sums;
  for (const KnownStep& step : KnownSteps()) {
    VisualOdometer odometer(ParamsOf(source), PlanePair(kSize), {}, {26, 0});
    odometer.Add(prepare(step.first));
    const OdometryStep seen = odometer.Add(prepare(step.second));
    if (!seen.result.motion) continue;
    Motion motion = *seen.result.motion;
    ++sums.found;
    sums.nees += NormalizedErrorSquared(motion, step.X_FS);
    motion.covariance /= 4.0;
    sums.nees_control += NormalizedErrorSquared(motion, step.X_FS);
    sums.squares_m2 += (motion.X_FS.translation() - step.X_FS.translation()).squaredNorm();
  }
  return sums;
}

AlignedImages AsTheyAre(const AlignedImages& images) { return images; }

// With a map that someone else has made, each disparity changed by `change`.
template <typename Change>
AlignedImages WithMap(AlignedImages images, const Change& change) {
  images.disparities =
      MakePlacementMap(images.left, images.right, ParamsOf(PlaceSource::kDisparityMap).placement);
  for (std::int16_t& disparity : images.disparities.values()) {
    if (IsValid(disparity)) disparity = change(disparity);
  }
  return images;
}

// Errors are no larger than their covariance says: chi-squared with 6 degrees of freedom a step,
// alpha 1e-4. The negative control states half the deviations.
TEST(MapMotionTest, ErrorsAreWithinWhatTheirCovarianceSays) {
  const Sums map = SumsOf(PlaceSource::kDisparityMap, AsTheyAre);
  ASSERT_EQ(map.found, kSteps);
  const double most = core::ChiSquaredQuantile(1.0 - 1e-4, 6 * kSteps);
  EXPECT_LT(map.nees, most);
  EXPECT_GT(map.nees_control, most);
}

// Twice as large at most. The negative control has cameras that are turned to each other by a
// pixel.
TEST(MapMotionTest, MotionsAreAboutAsGoodAsFromTheRightEye) {
  const Sums map = SumsOf(PlaceSource::kDisparityMap, AsTheyAre);
  const Sums eye = SumsOf(PlaceSource::kRightEye, AsTheyAre);
  const Sums turned = SumsOf(PlaceSource::kDisparityMap, [](const AlignedImages& images) {
    return WithMap(images, [](std::int16_t disparity) {
      return static_cast<std::int16_t>(disparity + kDisparityOne);
    });
  });
  EXPECT_EQ(eye.found, kSteps);
  EXPECT_LT(map.squares_m2, 4.0 * eye.squares_m2);
  EXPECT_GT(turned.squares_m2, 4.0 * eye.squares_m2);
}

// The first places are from the map of the first pair, the second ones from that of the second.
TEST(MapMotionTest, PlacesAreThoseOfTheMaps) {
  const KnownStep& step = KnownSteps().front();
  const OdometerParams params = ParamsOf(PlaceSource::kDisparityMap);
  VisualOdometer odometer(params, PlanePair(kSize), {}, {26, 0});
  odometer.Add(step.first);
  const OdometryStep seen = odometer.Add(step.second);
  const DisparityImage first =
      MakePlacementMap(step.first.left, step.first.right, params.placement);
  const DisparityImage second =
      MakePlacementMap(step.second.left, step.second.right, params.placement);
  ASSERT_GT(seen.consistent.size(), 30u);
  for (const PointSeenTwice& point : seen.consistent) {
    EXPECT_EQ(point.first.disparity_px, *DisparityAt(first, point.first.left, 1.0));
    EXPECT_EQ(point.second.disparity_px, *DisparityAt(second, point.second.left, 1.0));
  }
}

// A map that comes with the images is not made again: one of another world, in which everything is
// twice as near, has half the motion.
TEST(MapMotionTest, AMapThatIsThereIsUsed) {
  const KnownStep& step = KnownSteps().front();
  const auto nearer = [](const AlignedImages& images) {
    return WithMap(images,
                   [](std::int16_t disparity) { return static_cast<std::int16_t>(2 * disparity); });
  };
  VisualOdometer odometer(ParamsOf(PlaceSource::kDisparityMap), PlanePair(kSize), {}, {26, 0});
  odometer.Add(nearer(step.first));
  const OdometryStep seen = odometer.Add(nearer(step.second));
  ASSERT_TRUE(seen.result.motion);
  // Of points at C + u, about the cameras' centre C, twice as near: C + u / 2.
  const math::Vector3 C = PlanePair(kSize).left.C;
  const math::Vector3 of_centre_m = step.X_FS * C - C;
  EXPECT_NEAR((seen.result.motion->X_FS * C - C).norm(), 0.5 * of_centre_m.norm(), 0.004);
  AlignedImages wrong = step.first;
  wrong.disparities = DisparityImage(3, 3);
  EXPECT_THROW(odometer.Add(wrong), core::ContractViolation);
}

TEST(MapMotionTest, MakingTheMapIsAPartOfPlacing) {
  using enum OdometryStage;
  std::vector<OdometryStage> stages;
  VisualOdometer odometer(ParamsOf(PlaceSource::kDisparityMap), PlanePair(kSize), {}, {26, 0},
                          [&](OdometryStage stage) { stages.push_back(stage); });
  odometer.Add(KnownSteps().front().first);
  EXPECT_EQ(stages, (std::vector{kDetected, kPlaced, kRenewed}));
}

}  // namespace
}  // namespace rockyard::vision
