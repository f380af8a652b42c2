// Errors of estimated motions beside their covariance, and without bias where points are far.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "math/decompositions.h"
#include "vision/odometry/estimate_motion.h"
#include "vision/odometry/plain_motion.h"
#include "vision/odometry/synthetic_points.h"

namespace rockyard::vision {
namespace {

using math::Vector6;

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
  PointField field{.points = 60, .nearest_m = 20.0, .farthest_m = 60.0};
  field.covariance_px2 = Eigen::Vector3d(0.04, 0.04, 0.25).asDiagonal();
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

}  // namespace
}  // namespace rockyard::vision
