#include "sensing/visual_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "math/angles.h"

namespace rockyard::sensing {
namespace {

using math::Transform;
using math::Vector3;

VisualErrorModelParams Params() {
  return {.failure = {.intercept = -1000.0, .per_m = 0.0, .per_rad = 0.0},
          .along = {{.still = 0.001, .per_m = 0.01, .per_rad = 0.003}},
          .across = {{.still = 0.002, .per_m = 0.02, .per_rad = 0.004}},
          .up = {{.still = 0.003, .per_m = 0.03, .per_rad = 0.005}},
          .tilt = {{.still = 0.004, .per_m = 0.04, .per_rad = 0.006}},
          .heading = {{.still = 0.005, .per_m = 0.05, .per_rad = 0.007}}};
}

// 0.5 m and 0.2 rad about a slanted axis.
Transform Motion() {
  Transform X = Transform::Identity();
  X.linear() = Eigen::AngleAxisd(0.2, Vector3(0.1, 0.2, 0.9).normalized()).toRotationMatrix();
  X.translation() = Vector3(0.3, 0.4, 0.0);
  return X;
}

TEST(MotionErrorParamsTest, VariancesAddUp) {
  const MotionErrorParams error{.still = 0.3, .per_m = 0.2, .per_rad = 0.5};
  EXPECT_NEAR(error.Variance(2.0, 0.6), 0.09 + 0.16 + 0.09, 1e-12);
}

TEST(VisualFailureParamsTest, IsALogisticLaw) {
  const VisualFailureParams failure{.intercept = -3.0, .per_m = 1.0, .per_rad = 4.0};
  EXPECT_NEAR(failure.Probability(1.0, 0.5), 0.5, 1e-12);
  EXPECT_NEAR(failure.Probability(0.0, 0.0), 1.0 / (1.0 + std::exp(3.0)), 1e-12);
}

// The errors of 2000 motions against the covariance that comes with them, and as a control against
// one of half the size. Seed 3; alpha 1e-4 for each of both sides.
TEST(VisualMotionSensorTest, ErrsAsItsCovarianceSays) {
  const VisualMotion sensor(Params(), {3, 0});
  constexpr int kMotions = 2000;
  double nees = 0.0;
  for (int i = 0; i < kMotions; ++i) {
    const vision::MotionResult seen = sensor.Measure(Motion(), i);
    ASSERT_TRUE(seen.motion);
    const Eigen::AngleAxisd turned(seen.motion->X_FS.linear() * Motion().linear().transpose());
    Eigen::Matrix<double, 6, 1> error;
    error << seen.motion->X_FS.translation() - Motion().translation(),
        turned.angle() * turned.axis();
    nees += error.dot(seen.motion->covariance.ldlt().solve(error));
  }
  const double low = core::ChiSquaredQuantile(1e-4, 6 * kMotions);
  const double high = core::ChiSquaredQuantile(1.0 - 1e-4, 6 * kMotions);
  EXPECT_GT(nees, low);
  EXPECT_LT(nees, high);
  EXPECT_GT(2.0 * nees, high);
}

TEST(VisualMotionSensorTest, TheCovarianceIsThatOfTheParameters) {
  const auto covariance = VisualMotion(Params(), {3, 0}).Measure(Motion(), 0).motion->covariance;
  const double d = 0.5;
  const double a = 0.2;
  const auto variance = [&](double still, double per_m, double per_rad) {
    return still * still + per_m * d * per_m * d + per_rad * a * per_rad * a;
  };
  EXPECT_NEAR(covariance(0, 0), variance(0.001, 0.01, 0.003), 1e-12);
  EXPECT_NEAR(covariance(1, 1), variance(0.002, 0.02, 0.004), 1e-12);
  EXPECT_NEAR(covariance(2, 2), variance(0.003, 0.03, 0.005), 1e-12);
  EXPECT_NEAR(covariance(3, 3), variance(0.004, 0.04, 0.006), 1e-12);
  EXPECT_NEAR(covariance(4, 4), variance(0.004, 0.04, 0.006), 1e-12);
  EXPECT_NEAR(covariance(5, 5), variance(0.005, 0.05, 0.007), 1e-12);
  EXPECT_NEAR(covariance.sum(), covariance.trace(), 1e-15);
}

TEST(VisualMotionSensorTest, FailsAsOftenAsItsLawSays) {
  VisualErrorModelParams params = Params();
  params.failure = {.intercept = -1.0, .per_m = 0.0, .per_rad = 0.0};
  const VisualMotion sensor(params, {4, 0});
  constexpr int kMotions = 4000;
  int failures = 0;
  for (int i = 0; i < kMotions; ++i) {
    const vision::MotionResult seen = sensor.Measure(Motion(), i);
    EXPECT_NE(seen.motion.has_value(), seen.reason.has_value());
    failures += seen.motion ? 0 : 1;
  }
  const double p = 1.0 / (1.0 + std::exp(1.0));
  // Four standard deviations: alpha 6e-5.
  EXPECT_NEAR(failures, kMotions * p, 4.0 * std::sqrt(kMotions * p * (1.0 - p)));
}

TEST(VisualMotionSensorTest, IsAPureFunctionOfKeyAndNumber) {
  const VisualMotion sensor(Params(), {3, 7});
  const auto first = sensor.Measure(Motion(), 5).motion->X_FS.matrix();
  sensor.Measure(Motion(), 6);
  EXPECT_EQ(first, sensor.Measure(Motion(), 5).motion->X_FS.matrix());
  EXPECT_NE(first, sensor.Measure(Motion(), 6).motion->X_FS.matrix());
  EXPECT_NE(first, VisualMotion(Params(), {3, 8}).Measure(Motion(), 5).motion->X_FS.matrix());
}

}  // namespace
}  // namespace rockyard::sensing
