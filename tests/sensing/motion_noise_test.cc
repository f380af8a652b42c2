#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/json_file.h"
#include "core/random.h"
#include "localization/dead_reckoning.h"
#include "math/angles.h"
#include "noise_laws.h"
#include "sensing/motion_sensors.h"
#include "sensing/tracker.h"
#include "sensing/vehicle_sensors.h"
#include "sensing/visual_motion.h"

namespace rockyard::sensing {
namespace {

using math::Transform;
using math::Vector3;

// Growth of dead-reckoning errors against what Matthies 1995 measured on level sand (section 5),
// with wheels that roll without slip. Each test has a wrong model that it rejects.

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

// Spread of what the vehicle sensors report, against what their parameters say.

constexpr int kTicks = 20000;

TEST(VehicleNoiseTest, DeviationsAreThoseOfTheParameters) {
  VehicleSensorParams params{.articulation = {true, 0.004, 0.0, 0},
                             .accelerometers = {true, 0.03, 0.0, 0},
                             .motor_current = {true, 0.001, 0.0, 0, 20.0, 0.02}};
  rover::RoverParams rover{.physics = {.gravity_m_s2 = 3.72}};
  VehicleSensors sensors(params, rover, {20261121, 0});
  messages::WheelCommand command;
  command.rate_rad_s.fill(1.0);
  std::vector<double> bogie_rad, force_m_s2, current_A;
  for (int tick = 0; tick < kTicks; ++tick) {
    const messages::VehicleState state = sensors.Measure({}, command, 0.1);
    bogie_rad.push_back(state.articulation->right_bogie_rad);
    force_m_s2.push_back(state.specific_force_R->z());
    current_A.push_back((*state.motor_current_A)[4]);
  }
  EXPECT_GT(VarianceP(bogie_rad, 0.0, 0.004), kAlpha);
  EXPECT_GT(VarianceP(force_m_s2, 3.72, 0.03), kAlpha);
  EXPECT_GT(VarianceP(current_A, 0.02, 0.001), kAlpha);
  // Negative control: five per cent more.
  EXPECT_LT(VarianceP(bogie_rad, 0.0, 1.05 * 0.004), kAlpha);
  EXPECT_LT(VarianceP(force_m_s2, 3.72, 1.05 * 0.03), kAlpha);
  EXPECT_LT(VarianceP(current_A, 0.02, 1.05 * 0.001), kAlpha);
}

TEST(VehicleNoiseTest, FalseTouchesComeAsOftenAsTheyShould) {
  VehicleSensorParams params;
  params.contact = {.enabled = true, .false_probability = 0.01, .latency_ticks = 0};
  VehicleSensors sensors(params, {}, {20261122, 0});
  double touches = 0.0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const messages::VehicleState state = sensors.Measure({}, {}, 0.1);
    for (const bool closed : *state.contact) touches += closed;
  }
  const double chances = kTicks * static_cast<double>(messages::kContactSwitchCount);
  EXPECT_GT(CountP(touches, chances, 0.01), kAlpha);
  EXPECT_LT(CountP(touches, chances, 0.0115), kAlpha);  // negative control
}

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
