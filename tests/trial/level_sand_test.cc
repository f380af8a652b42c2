// The calibration runs of Matthies 1995, section 5: straight drives over 7 m of level sand show the
// published growth of heading and distance variance, and no mean distance error.
//
// Heading error (believed less true) and distance error (odometer less true path) are Brownian in
// the distance: what they gain over disjoint stretches of 1 m is independent with variance q times
// the length. So with n stretches sum((e - mean)^2 / L) / q is chi-square with n - 1 degrees of
// freedom. Each test has alpha = 1e-3; its negative control goes through the same function.
//
// The slope that figure 5 fits to the squared errors along the runs is the published value itself:
// to 4 standard errors of the mean over many quasi-static runs (alpha = 6e-5 each).
#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "math/angles.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

constexpr double kAlpha = 1e-3;
constexpr double kStretch_m = 1.0;
constexpr std::uint32_t kRuns = 60;
constexpr std::uint32_t kNoiselessRuns = 20;
constexpr double kHeadingVariance_deg2_per_m = 0.70;  // Matthies 1995 sec. 5
constexpr double kDistanceVariance_m2_per_m = 0.0039;

struct Stretch {
  double length_m = 0.0;
  double heading_error_deg = 0.0;
  double distance_error_m = 0.0;
};

// What the errors gain over each whole metre of one drive.
std::vector<Stretch> StretchesOf(const truth::Trace& trace) {
  std::vector<Stretch> stretches;
  Stretch now;
  truth::TraceSample last = trace.samples.front();
  for (const truth::TraceSample& sample : trace.samples) {
    const double step_m =
        std::hypot(sample.pose.x_m - last.pose.x_m, sample.pose.y_m - last.pose.y_m);
    const double believed_turn_rad = sample.estimate.heading_rad - last.estimate.heading_rad;
    const double true_turn_rad = sample.pose.heading_rad - last.pose.heading_rad;
    now.length_m += step_m;
    now.heading_error_deg += math::RadToDeg(math::WrapAngle(believed_turn_rad - true_turn_rad));
    now.distance_error_m += sample.estimate.distance_m - last.estimate.distance_m - step_m;
    last = sample;
    if (now.length_m < kStretch_m) continue;
    stretches.push_back(now);
    now = {};
  }
  return stretches;
}

struct Drives {
  std::vector<Stretch> stretches;
  std::vector<double> distance_error_percent;  // by run, from the records
};

Drives DriveAll(std::uint32_t runs, const Overrides& overrides) {
  const DriveParams drive = Pathfinder("level_sand", overrides);
  Drives drives;
  for (std::uint32_t i = 0; i < runs; ++i) {
    const TracedTrial trial = RunTraced(drive, i);
    EXPECT_TRUE(truth::DeclaredSuccess(trial.result.outcome)) << trial.result.detail;
    const std::vector<Stretch> stretches = StretchesOf(trial.trace);
    drives.stretches.insert(drives.stretches.end(), stretches.begin(), stretches.end());
    drives.distance_error_percent.push_back(trial.result.record.distance_error_percent);
  }
  return drives;
}

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double SumOfSquares(const std::vector<double>& values) {
  const double mean = Mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum;
}

// Whether the growth of the variance agrees with `per_m`; says the estimate and its interval.
testing::AssertionResult GrowsBy(double per_m, double Stretch::*error, const Drives& drives) {
  std::vector<double> normalized;
  for (const Stretch& stretch : drives.stretches) {
    normalized.push_back(stretch.*error / std::sqrt(stretch.length_m));
  }
  const double sum = SumOfSquares(normalized);
  const auto degrees = static_cast<double>(normalized.size() - 1);
  const boost::math::chi_squared law(degrees);
  const double low = sum / boost::math::quantile(law, 1.0 - 0.5 * kAlpha);
  const double high = sum / boost::math::quantile(law, 0.5 * kAlpha);
  const bool agrees = low <= per_m && per_m <= high;
  return (agrees ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "variance per metre " << sum / degrees << ", interval " << low << " to " << high
         << " from " << normalized.size() << " stretches, held against " << per_m;
}

// Whether the mean of the runs' distance errors agrees with zero (Student's t).
testing::AssertionResult NoMeanDistanceError(const Drives& drives) {
  const std::vector<double>& errors = drives.distance_error_percent;
  const auto n = static_cast<double>(errors.size());
  const double standard_error = std::sqrt(SumOfSquares(errors) / (n - 1.0) / n);
  const double bound =
      standard_error * boost::math::quantile(boost::math::students_t(n - 1.0), 1.0 - 0.5 * kAlpha);
  const bool agrees = std::abs(Mean(errors)) <= bound;
  return (agrees ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "mean distance error " << Mean(errors) << " %, bound " << bound << " %";
}

TEST(LevelSandTest, ErrorsGrowAsPublished) {
  const Drives drives = DriveAll(kRuns, {});
  ASSERT_GE(drives.stretches.size(), 5u * kRuns);
  EXPECT_TRUE(GrowsBy(kHeadingVariance_deg2_per_m, &Stretch::heading_error_deg, drives));
  EXPECT_TRUE(GrowsBy(kDistanceVariance_m2_per_m, &Stretch::distance_error_m, drives));
  EXPECT_TRUE(NoMeanDistanceError(drives));
}

TEST(LevelSandTest, NoiseHalfAsStrongAgainIsRejected) {
  const Drives drives = DriveAll(kRuns, {"sensors.gyro.heading_variance_deg2_per_m=1.05",
                                         "sensors.encoders.distance_variance_m2_per_m=0.00585"});
  EXPECT_FALSE(GrowsBy(kHeadingVariance_deg2_per_m, &Stretch::heading_error_deg, drives));
  EXPECT_FALSE(GrowsBy(kDistanceVariance_m2_per_m, &Stretch::distance_error_m, drives));
}

constexpr std::uint32_t kSlopeRuns = 600;
constexpr double kStandardErrors = 4.0;

constexpr auto kHeadingGrowth = &truth::DriveRecord::heading_growth_deg2_per_m;
constexpr auto kDistanceGrowth = &truth::DriveRecord::distance_growth_m2_per_m;

std::vector<double> SlopesOf(double truth::DriveRecord::*column, const Overrides& overrides) {
  const Overrides quasi_static{"rover.fidelity=quasi_static"};
  const DriveParams drive = Pathfinder("level_sand", quasi_static + overrides);
  std::vector<double> slopes;
  for (const DriveResult& result : RunTrials(drive, kSlopeRuns)) {
    slopes.push_back(result.record.*column);
  }
  return slopes;
}

// Whether the mean slope agrees with the published one.
testing::AssertionResult MeanIs(double published, const std::vector<double>& slopes) {
  const auto n = static_cast<double>(slopes.size());
  const double standard_error = std::sqrt(SumOfSquares(slopes) / (n - 1.0) / n);
  const bool agrees = std::abs(Mean(slopes) - published) <= kStandardErrors * standard_error;
  return (agrees ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "slope " << Mean(slopes) << " +- " << standard_error << ", held against " << published;
}

TEST(LevelSandSlopeTest, OfHeadingErrorsIsThePublishedOne) {
  EXPECT_TRUE(MeanIs(kHeadingVariance_deg2_per_m, SlopesOf(kHeadingGrowth, {})));
}

TEST(LevelSandSlopeTest, OfDistanceErrorsIsThePublishedOne) {
  EXPECT_TRUE(MeanIs(kDistanceVariance_m2_per_m, SlopesOf(kDistanceGrowth, {})));
}

// Negative controls: gains that are off by half, either way.
TEST(LevelSandSlopeTest, OtherGainsOfTheGyroAreRejected) {
  for (const std::string gain : {"0.77", "1.74"}) {
    EXPECT_FALSE(MeanIs(kHeadingVariance_deg2_per_m,
                        SlopesOf(kHeadingGrowth, {"sensors.gyro.level_sand_gain=" + gain})))
        << gain;
  }
}

TEST(LevelSandSlopeTest, OtherGainsOfTheEncodersAreRejected) {
  for (const std::string gain : {"0.6", "1.4"}) {
    EXPECT_FALSE(MeanIs(kDistanceVariance_m2_per_m,
                        SlopesOf(kDistanceGrowth, {"sensors.encoders.level_sand_gain=" + gain})))
        << gain;
  }
}

// Encoders without noise leave the slip of the wheels alone, so that the mean error is known to a
// few hundredths of a per cent: as when the scale was calibrated.
constexpr const char* kNoNoise = "sensors.encoders.distance_variance_m2_per_m=1.2e-5";

TEST(LevelSandTest, DistanceScaleIsTheCalibratedOne) {
  EXPECT_TRUE(NoMeanDistanceError(DriveAll(kNoiselessRuns, {kNoNoise})));
}

TEST(LevelSandTest, DistanceScaleThatIsOnePerCentOffIsRejected) {
  const std::string scale =
      std::to_string(1.01 * Pathfinder("level_sand").perception.dead_reckoning.distance_scale);
  EXPECT_FALSE(NoMeanDistanceError(
      DriveAll(kNoiselessRuns, {kNoNoise, "perception.dead_reckoning.distance_scale=" + scale})));
}

}  // namespace
}  // namespace rockyard::trial
