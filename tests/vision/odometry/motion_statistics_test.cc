#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/check.h"
#include "core/random.h"
#include "math/decompositions.h"
#include "vision/odometry/estimate_motion.h"
#include "vision/odometry/odometer.h"
#include "vision/odometry/place_features.h"
#include "vision/odometry/plain_motion.h"
#include "vision/odometry/synthetic_points.h"
#include "vision/odometry/synthetic_sequence.h"
#include "vision/odometry/trajectory_error.h"

namespace rockyard::vision {
namespace {

using math::MakePose;
using math::Transform;
using math::Vector6;

// Errors of estimated motions beside their covariance, and without bias where points are far.

constexpr int kRuns = 400;

core::RandomStream Stream(std::uint32_t substream) {
  return {{253, 0}, core::Purpose::kTest, substream};
}

// Sum over the runs of e' P^-1 e, P times `scale`.
double SumOfSquaredErrors(const PointField& field, double scale) {
  double sum = 0.0;
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    core::RandomStream stream = Stream(run);
    const PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), field, stream);
    const EstimatedMotion found = EstimateMotion(points, kOdometryPair, {}, TestMotion());
    EXPECT_TRUE(found.motion) << run;
    if (!found.motion) continue;
    const Vector6 error = ErrorOf(found.motion->X_FS, TestMotion());
    sum += error.dot(math::SolveSymmetric(scale * found.motion->covariance, error));
  }
  return sum;
}

// Two-sided alpha 0.001 of chi-squared with 6 * 400 degrees of freedom.
bool IsWithin(double sum) {
  return sum > core::ChiSquaredQuantile(0.0005, 6 * kRuns) &&
         sum < core::ChiSquaredQuantile(0.9995, 6 * kRuns);
}

TEST(MotionStatisticsTest, ErrorsAreAsTheirCovarianceSays) {
  const PointField field;
  const double sum = SumOfSquaredErrors(field, 1.0);
  EXPECT_TRUE(IsWithin(sum)) << sum / kRuns << " instead of 6";
  // Negative control: half the covariance.
  EXPECT_FALSE(IsWithin(SumOfSquaredErrors(field, 0.5)));
}

TEST(MotionStatisticsTest, SoTheyAreWithNearAndFarPoints) {
  const PointField field{.nearest_m = 1.5, .farthest_m = 60.0};
  const double sum = SumOfSquaredErrors(field, 1.0);
  EXPECT_TRUE(IsWithin(sum)) << sum / kRuns << " instead of 6";
}

// Points at 20 to 60 m have disparities of 6 to 2 px, each known to 0.5 px: their range has a long
// tail. In images the mean error over the runs is zero within its own deviation along every number
// (alpha 0.001 for the six together: 3.76 sd each); in space (Matthies 1989, to first order) it is
// not, the negative control.
TEST(MotionStatisticsTest, FarPointsBiasErrorsInSpaceAndNotErrorsInImages) {
  PointField field{.points = 60,
                   .nearest_m = 20.0,
                   .farthest_m = 60.0,
                   .covariance_px2 = Eigen::Vector3d(0.04, 0.04, 0.25).asDiagonal()};
  const EstimationParams params{.max_position_sd_m = 100.0};
  const auto largest_bias_sd = [&](const auto& estimate) {
    Vector6 sum = Vector6::Zero();
    Vector6 squares = Vector6::Zero();
    for (std::uint32_t run = 0; run < kRuns; ++run) {
      core::RandomStream stream = Stream(10000 + run);
      const PointsSeenTwice points = SeeTwice(kOdometryPair, TestMotion(), field, stream);
      const Vector6 error = ErrorOf(estimate(points), TestMotion());
      sum += error;
      squares += error.cwiseAbs2();
    }
    const Vector6 mean = sum / kRuns;
    const Vector6 sd_of_mean = ((squares / kRuns - mean.cwiseAbs2()) / kRuns).cwiseSqrt();
    return (mean.array() / sd_of_mean.array()).abs().maxCoeff();
  };
  EXPECT_LT(largest_bias_sd([&](const PointsSeenTwice& points) {
              return EstimateMotion(points, kOdometryPair, params, TestMotion()).X_FS;
            }),
            3.76);
  EXPECT_GT(largest_bias_sd([&](const PointsSeenTwice& points) {
              return MotionInSpace(points, TestMotion()).X_FS;
            }),
            3.76);
}

// The covariance of one motion after another against that of drawn errors.

Eigen::Matrix3d Turned(const math::Vector3& turn) {
  return Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
}

Transform Disturbed(const Transform& X, const Vector6& error) {
  Transform disturbed = X;
  disturbed.translation() += error.head<3>();
  disturbed.linear() = Turned(error.tail<3>()) * X.linear();
  return disturbed;
}

TEST(ComposeMotion, TheCovarianceIsThatOfDrawnErrors) {
  // 20,000 draws know a variance to 1 % (one deviation): bounds of 5 %. Seed 8.
  core::RandomStream stream({8, 0}, core::Purpose::kTest);
  Motion first{.X_FS = MakePose({2.0, -1.0, 0.5}, 1.0, 0.3, -0.2)};
  Motion second{.X_FS = MakePose({1.5, 0.8, -0.4}, -0.6, 0.2, 0.4)};
  Eigen::Matrix<double, 6, 6> roots[2];
  for (auto& root : roots) {
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) root(i, j) = 1e-3 * (stream.Uniform() - (i == j ? -1.0 : 0.3));
    }
  }
  first.covariance = roots[0] * roots[0].transpose();
  second.covariance = roots[1] * roots[1].transpose();
  const Motion whole = Compose(first, second);
  EXPECT_TRUE(whole.X_FS.isApprox(first.X_FS * second.X_FS, 1e-12));

  constexpr int kDraws = 20000;
  MotionCovariance drawn = MotionCovariance::Zero();
  const auto draw = [&](const auto& root) {
    Vector6 normal;
    for (int i = 0; i < 6; ++i) normal[i] = core::SampleNormal(stream, 0.0, 1.0);
    return Vector6(root * normal);
  };
  for (int i = 0; i < kDraws; ++i) {
    const Transform X =
        Disturbed(first.X_FS, draw(roots[0])) * Disturbed(second.X_FS, draw(roots[1]));
    const Vector6 error = ErrorOf(whole.X_FS, X);
    drawn += error * error.transpose() / kDraws;
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double scale = std::sqrt(whole.covariance(i, i) * whole.covariance(j, j));
      EXPECT_NEAR(drawn(i, j), whole.covariance(i, j), 0.05 * scale) << i << " " << j;
    }
  }
}

TEST(ComposeMotion, NothingIsKnownBetterAfterwards) {
  const Motion first{.covariance = MotionCovariance::Identity()};
  Motion exact{.X_FS = MakePose({3.0, 0.0, 0.0}, 0.5, 0.0, 0.0)};
  // A lever of 3 m adds 9 times the variance of heading and pitch to the position.
  const Motion whole = Compose(first, exact);
  EXPECT_NEAR(whole.covariance(0, 0), 1.0, 1e-12);
  EXPECT_NEAR(whole.covariance(1, 1), 10.0, 1e-12);
  EXPECT_NEAR(whole.covariance(2, 2), 10.0, 1e-12);
  EXPECT_NEAR(whole.covariance(1, 5), 3.0, 1e-12);
  EXPECT_NEAR(whole.covariance(2, 4), -3.0, 1e-12);
  EXPECT_TRUE(Compose(exact, first).covariance.isApprox(MotionCovariance::Identity(), 1e-12));
}

// Motions whose points have their places from a disparity map, beside those from the right eye, on
// images of a plane.

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

// Steps do not nod the camera: neither does level ground, nor do the edges of what stands on it.

constexpr std::uint32_t kWorlds = 12;

struct Errors {
  double mean_rad = 0.0;
  double rms_rad = 0.0;
};

// Of the pitch of steps over as many textures, predicted a tenth too long.
Errors PitchErrors(double step_m, double boards_m, const PlacementParams& placement) {
  const ImageSize size{256, 256};
  const RectifiedPair pair = PlanePair(size);
  const math::Transform X_FS = math::MakePose({step_m, 0.0, 0.0}, 0.0, 0.0, 0.0);
  const math::Transform predicted = math::MakePose({1.1 * step_m, 0.0, 0.0}, 0.0, 0.0, 0.0);
  OdometerParams params;
  params.placement = placement;
  Errors errors;
  for (std::uint32_t number = 0; number < kWorlds; ++number) {
    const PlaneWorld world{.number = number, .boards_m = boards_m};
    VisualOdometer odometer(params, pair, {}, {261, number});
    odometer.Add(SeePlane(pair, math::Transform::Identity(), world, 0));
    const OdometryStep step = odometer.Add(SeePlane(pair, X_FS, world, 1), predicted);
    EXPECT_TRUE(step.result.motion) << number;
    if (!step.result.motion) continue;
    const double error_rad = ErrorOf(step.result.motion->X_FS, X_FS)(4);
    errors.mean_rad += error_rad / kWorlds;
    errors.rms_rad += error_rad * error_rad / kWorlds;
  }
  errors.rms_rad = std::sqrt(errors.rms_rad);
  return errors;
}

// The limit of the mean is three times its standard error, that of the root mean square twice what
// the errors are. The control takes all windows to face the cameras.
TEST(GroundBiasTest, LevelGroundDoesNotNod) {
  constexpr double kMean_rad = 8e-5;
  constexpr double kRms_rad = 2e-4;
  PlacementParams params;
  params.max_residual_ratio = 1e6;  // windows that do not fit are not left out
  const Errors slanted = PitchErrors(0.75, 0.0, params);
  EXPECT_LT(std::abs(slanted.mean_rad), kMean_rad);
  EXPECT_LT(slanted.rms_rad, kRms_rad);
  params.slanted = false;
  const Errors facing = PitchErrors(0.75, 0.0, params);
  EXPECT_GT(std::abs(facing.mean_rad), kMean_rad);
  EXPECT_GT(facing.rms_rad, kRms_rad);
}

// Boards stand on the ground, whose edges are in many windows. The control keeps these: it
// nods by 1 mrad. Small windows have fewer edges in them, and fewer are to be left out.
TEST(GroundBiasTest, EdgesNodLittleAndLessInSmallWindows) {
  constexpr double kMean_rad = 5e-4;
  PlacementParams params;
  EXPECT_LT(std::abs(PitchErrors(0.5, 0.4, params).mean_rad), kMean_rad);
  params.max_residual_ratio = 1e6;
  const Errors kept = PitchErrors(0.5, 0.4, params);
  EXPECT_GT(std::abs(kept.mean_rad), kMean_rad);
  params.window_px = 9;
  EXPECT_LT(PitchErrors(0.5, 0.4, params).rms_rad, 0.8 * kept.rms_rad);
}

}  // namespace
}  // namespace rockyard::vision
