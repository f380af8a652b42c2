// Growth of dead-reckoning errors against what Matthies 1995 measured on level sand (section 5),
// with wheels that roll without slip. Each test has a wrong model that it rejects.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/json_file.h"
#include "localization/dead_reckoning.h"
#include "noise_laws.h"
#include "sensing/motion_sensors.h"
#include "sensing/tracker.h"

namespace rockyard::sensing {
namespace {

constexpr double kRadius_m = 0.065;
constexpr double kSpeed_m_s = 0.15;

struct Errors {
  std::vector<double> x_m, y_m, heading_deg, distance_m;
};

// Straight drives in steps, dead-reckoned with the state equations of section 5.
Errors DriveStraight(std::uint32_t runs, int steps, double step_m, const GyroParams& gyro,
                     const EncoderParams& encoders) {
  const localization::DeadReckoningParams params{.step_heading = localization::StepHeading::kStart};
  const messages::DriveCalibration calibration{.wheel_radius_m = kRadius_m};
  Errors errors;
  for (std::uint32_t run = 0; run < runs; ++run) {
    truth::RoverState state;
    MotionSensors sensors(gyro, encoders, kRadius_m, {20260105, run}, state);
    localization::DeadReckoning dead_reckoning(calibration, params, {});
    for (int i = 0; i < steps; ++i) {
      for (double& angle : state.wheel_angle_rad) angle += step_m / kRadius_m;
      dead_reckoning.Integrate(sensors.Measure(state, step_m / kSpeed_m_s, true));
    }
    const auto& estimate = dead_reckoning.estimate();
    errors.x_m.push_back(estimate.x_m);
    errors.y_m.push_back(estimate.y_m);
    errors.heading_deg.push_back(math::RadToDeg(estimate.heading_rad));
    errors.distance_m.push_back(estimate.distance_m - steps * step_m);
  }
  return errors;
}

double Mean(const std::vector<double>& sample) {
  double sum = 0.0;
  for (const double value : sample) sum += value;
  return sum / static_cast<double>(sample.size());
}

double Variance(const std::vector<double>& sample) {
  const double mean = Mean(sample);
  double sum = 0.0;
  for (const double value : sample) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(sample.size() - 1);
}

// Two-sided p-value of the variance of a normal sample.
double SampleVarianceP(const std::vector<double>& sample, double variance) {
  const double degrees = static_cast<double>(sample.size()) - 1.0;
  return SumOfSquaresP(degrees * Variance(sample), degrees, variance);
}

// Two-sided p-value of the mean of a sample.
double ZeroMeanP(const std::vector<double>& sample) {
  const double error = std::sqrt(Variance(sample) / static_cast<double>(sample.size()));
  return std::erfc(std::abs(Mean(sample)) / error / std::numbers::sqrt2);
}

constexpr double kHeadingVariance_deg2 = 0.70 * 7.0;
constexpr double kDistanceVariance_m2 = 0.0039 * 7.0;

TEST(StraightSevenMetresTest, VariancesAreThePublishedOnes) {
  const Errors errors = DriveStraight(20000, 20, 0.35, {}, {});
  EXPECT_GT(SampleVarianceP(errors.heading_deg, kHeadingVariance_deg2), kAlpha);
  EXPECT_GT(SampleVarianceP(errors.distance_m, kDistanceVariance_m2), kAlpha);
  EXPECT_GT(ZeroMeanP(errors.heading_deg), kAlpha);
  EXPECT_GT(ZeroMeanP(errors.distance_m), kAlpha);
}

TEST(StraightSevenMetresTest, TickLengthDoesNotMatter) {
  const Errors errors = DriveStraight(2000, 467, 7.0 / 467, {}, {});  // 0.1 s
  EXPECT_GT(SampleVarianceP(errors.heading_deg, kHeadingVariance_deg2), kAlpha);
  EXPECT_GT(SampleVarianceP(errors.distance_m, kDistanceVariance_m2), kAlpha);
  EXPECT_GT(ZeroMeanP(errors.distance_m), kAlpha);
}

TEST(StraightSevenMetresTest, NegativeControlTwentyPercentMoreVariance) {
  GyroParams gyro;
  gyro.heading_variance_deg2_per_m *= 1.2;
  EncoderParams encoders;
  encoders.distance_variance_m2_per_m *= 1.2;
  const Errors errors = DriveStraight(5000, 20, 0.35, gyro, encoders);
  EXPECT_LT(SampleVarianceP(errors.heading_deg, kHeadingVariance_deg2), kAlpha);
  EXPECT_LT(SampleVarianceP(errors.distance_m, kDistanceVariance_m2), kAlpha);
}

TEST(StraightSevenMetresTest, EncodersAddOnlyWhatPhysicsLeaves) {
  const EncoderParams encoders{.physics_variance_m2_per_m = 0.0019};
  const Errors errors = DriveStraight(5000, 20, 0.35, {}, encoders);
  EXPECT_GT(SampleVarianceP(errors.distance_m, 0.0020 * 7.0), kAlpha);
  EXPECT_LT(SampleVarianceP(errors.distance_m, kDistanceVariance_m2), kAlpha);
}

TEST(StraightSevenMetresTest, GrowthIsLinear) {
  const Errors half = DriveStraight(5000, 10, 0.35, {}, {});
  EXPECT_GT(SampleVarianceP(half.heading_deg, 0.5 * kHeadingVariance_deg2), kAlpha);
  EXPECT_GT(SampleVarianceP(half.distance_m, 0.5 * kDistanceVariance_m2), kAlpha);
  // Negative control: growth with the square.
  EXPECT_LT(SampleVarianceP(half.heading_deg, 0.25 * kHeadingVariance_deg2), kAlpha);
  EXPECT_LT(SampleVarianceP(half.distance_m, 0.25 * kDistanceVariance_m2), kAlpha);
}

// Difference of a sample standard deviation from `exact` in units of its own standard error, from
// the sample's fourth moment: x is not normal.
double DeviationZ(const std::vector<double>& sample, double exact) {
  const double mean = Mean(sample);
  const double variance = Variance(sample);
  double fourth = 0.0;
  for (const double value : sample) fourth += std::pow(value - mean, 4);
  fourth /= static_cast<double>(sample.size());
  const double error =
      std::sqrt((fourth - variance * variance) / static_cast<double>(sample.size())) /
      (2.0 * std::sqrt(variance));
  return (std::sqrt(variance) - exact) / error;
}

class SectionFiveTest : public testing::TestWithParam<std::string> {};

TEST_P(SectionFiveTest, MomentsAreTheExactOnes) {
  const core::JsonValue all =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/drift/drift_exact.json");
  const core::JsonValue* exact = all.Find(GetParam());
  ASSERT_NE(exact, nullptr);
  const auto value = [&](std::string_view key) { return exact->Find(key)->number(); };
  const Errors errors =
      DriveStraight(8000, static_cast<int>(exact->Find("steps")->integer()), 0.067, {}, {});
  constexpr double kLimit = 3.9;  // standard errors, for kAlpha
  EXPECT_LT(std::abs(DeviationZ(errors.x_m, value("sd_x"))), kLimit);
  EXPECT_LT(std::abs(DeviationZ(errors.y_m, value("sd_y"))), kLimit);
  EXPECT_LT(std::abs(DeviationZ(errors.heading_deg, value("sd_theta_deg"))), kLimit);
  const double mean_error =
      std::sqrt(Variance(errors.x_m) / static_cast<double>(errors.x_m.size()));
  EXPECT_LT(std::abs(Mean(errors.x_m) - value("mean_x")) / mean_error, kLimit);
  // Negative control: 1.2 times the variance is 9.5 % in the deviation.
  EXPECT_GT(std::abs(DeviationZ(errors.x_m, std::sqrt(1.2) * value("sd_x"))), kLimit);
  EXPECT_GT(std::abs(DeviationZ(errors.y_m, std::sqrt(1.2) * value("sd_y"))), kLimit);
}

INSTANTIATE_TEST_SUITE_P(Figure6, SectionFiveTest,
                         testing::Values("rocky32_0.70@5m", "rocky32_0.70@10m"));

TEST(MotionNoiseTest, ScrapeJumpsGoEitherWayEquallyOften) {
  int left = 0;
  constexpr int kTrials = 20000;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    ScrapeDetector detector({}, {20260106, trial});
    const truth::RoverState state{.contacts = {{.part = truth::BodyPart::kHub,
                                                .rock = 0,
                                                .normal_force_N = 5.0,
                                                .sliding_speed_m_s = 0.1}}};
    left += detector.Observe(state, 0.0) > 0.0;
  }
  EXPECT_GT(CountP(left, kTrials, 0.5), kAlpha);
  EXPECT_LT(CountP(left, kTrials, 0.52), kAlpha);  // negative control
}

TEST(MotionNoiseTest, TrackerRepeatability) {
  const Tracker tracker({}, {20260107, 0});
  std::vector<double> x_m, y_m, heading_deg;
  for (std::int64_t sample = 0; sample < 20000; ++sample) {
    const math::Pose2 seen = tracker.Observe({}, sample);
    x_m.push_back(seen.x_m);
    y_m.push_back(seen.y_m);
    heading_deg.push_back(math::RadToDeg(seen.heading_rad));
  }
  // 0.3 mm RMS in the plane is 0.3 / sqrt 2 per axis.
  EXPECT_GT(SampleVarianceP(x_m, 0.5 * 0.0003 * 0.0003), kAlpha);
  EXPECT_GT(SampleVarianceP(y_m, 0.5 * 0.0003 * 0.0003), kAlpha);
  EXPECT_GT(SampleVarianceP(heading_deg, 0.2 * 0.2), kAlpha);
  EXPECT_LT(SampleVarianceP(heading_deg, 1.2 * 0.2 * 0.2), kAlpha);  // negative control
}

}  // namespace
}  // namespace rockyard::sensing
