// Calibration of everything that resamples. Fixed seeds; each test states what it would reject.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "statistics/kolmogorov.h"
#include "statistics/predictive.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

std::vector<double> Exponentials(std::uint32_t set, std::size_t n, double mean) {
  core::RandomStream stream({.seed = 31, .trial = set}, core::Purpose::kTest);
  std::vector<double> sample(n);
  for (double& x : sample) x = core::SampleExponential(stream, mean);
  return sample;
}

std::vector<double> Normals(std::uint32_t set, std::size_t n, double mean) {
  core::RandomStream stream({.seed = 32, .trial = set}, core::Purpose::kTest);
  std::vector<double> sample(n);
  for (double& x : sample) x = core::SampleNormal(stream, mean, 1.0);
  return sample;
}

double MeanOf(std::span<const double> x) { return MomentsOf(x).mean(); }
double FrontOf(std::span<const double> x) { return x.front(); }

double UniformLaw(double x) { return std::clamp(x, 0.0, 1.0); }

// Uniform p-values under the null: Kolmogorov test at alpha = 0.01 over the p-values.
TEST(ExponentialTail, PValuesAreUniformForShiftedExponentialsOfAnyScale) {
  const std::vector<double> null = ExponentialNullLaw(39, 4000, 1);
  std::vector<double> p_values;
  for (std::uint32_t set = 0; set < 500; ++set) {
    std::vector<double> sample = Exponentials(set, 40, 0.1 + set);
    for (double& x : sample) x += 7.6;
    std::sort(sample.begin(), sample.end());
    p_values.push_back(BootstrapPValue(null, ExponentialStatistic(sample)));
  }
  EXPECT_GT(KolmogorovSmirnov(p_values, UniformLaw).p_value, 0.01);
}

// Negative control: a plain Kolmogorov-Smirnov p-value with fitted parameters is far from uniform.
TEST(ExponentialTail, PlainKolmogorovWithFittedParametersIsNotUniform) {
  std::vector<double> p_values;
  for (std::uint32_t set = 0; set < 500; ++set) {
    std::vector<double> sample = Exponentials(set, 40, 1.0);
    std::sort(sample.begin(), sample.end());
    p_values.push_back(KolmogorovExactPValue(ExponentialStatistic(sample), 39));
  }
  EXPECT_LT(KolmogorovSmirnov(p_values, UniformLaw).p_value, 1e-6);
}

TEST(ExponentialTail, RejectsWhatIsNotExponential) {
  EXPECT_LT(ExponentialTailTest(Normals(1, 200, 0.0), 1, 0, 999).p_value, 0.01);
  EXPECT_GT(ExponentialTailTest(Exponentials(1, 200, 1.0), 1, 0, 999).p_value, 0.01);
  // Exponential only beyond its lower half: rejected as a whole, not beyond the median.
  std::vector<double> bent = Exponentials(2, 200, 1.0);
  for (std::size_t i = 0; i < 100; ++i) bent.push_back(-2.0 - 0.01 * static_cast<double>(i));
  EXPECT_LT(ExponentialTailTest(bent, 1, 0, 999).p_value, 0.01);
  EXPECT_GT(ExponentialTailTest(bent, 1, 110, 999).p_value, 0.01);
  EXPECT_EQ(ExponentialTailTest({}, 1).p_value, 1.0);
}

TEST(Predictive, SmallestOfTheNewSampleLiesBelowThePoolAsOftenAsItMust) {
  // n / (N + n), whatever the law: 40 beside 60 fall below the pool's minimum in 40 % of cases.
  const PredictiveSampler sampler(Exponentials(3, 60, 1.0));
  const auto smallest = PredictiveStatistics(sampler, 40, FrontOf, 4000, {.seed = 1, .trial = 0});
  const auto below = std::count_if(smallest.begin(), smallest.end(),
                                   [&](double x) { return x < sampler.pool().front(); });
  EXPECT_NEAR(static_cast<double>(below) / 4000.0, 0.4, 4.0 * std::sqrt(0.24 / 4000.0));
}

TEST(Predictive, RespectsALowerLimit) {
  const PredictiveSampler sampler(Exponentials(4, 20, 1.0), 0.0);
  const auto smallest = PredictiveStatistics(sampler, 40, FrontOf, 2000, {.seed = 1, .trial = 0});
  EXPECT_GE(*std::min_element(smallest.begin(), smallest.end()), 0.0);
}

using Law = std::vector<double> (*)(std::uint32_t set, std::size_t n, double parameter);

// Share of rejections at 0.05 over many pairs of a pool of 300 and a published set of 40.
double RejectionRate(const SampleStatistic& statistic, Law law, double pool_parameter,
                     double published_parameter) {
  constexpr std::uint32_t kPairs = 200;
  int rejected = 0;
  for (std::uint32_t pair = 0; pair < kPairs; ++pair) {
    std::vector<double> published = law(2 * pair + 1, 40, published_parameter);
    std::sort(published.begin(), published.end());
    const PredictiveSampler sampler(law(2 * pair, 300, pool_parameter));
    auto drawn = PredictiveStatistics(sampler, 40, statistic, 300, {.seed = 9, .trial = pair});
    std::sort(drawn.begin(), drawn.end());
    rejected += PredictivePValue(drawn, statistic(published), 0.0) <= 0.05 ? 1 : 0;
  }
  return rejected / static_cast<double>(kPairs);
}

TEST(Predictive, FalseAlarmRateIsNominalForEveryStatistic) {
  // 0.05 give or take 3.5 sigma of 200 pairs: 0.104 at most.
  const SampleStatistic statistics[] = {FrontOf, [](std::span<const double> x) { return x.back(); },
                                        HalfSampleMode, MeanOf};
  for (const SampleStatistic& statistic : statistics) {
    EXPECT_LE(RejectionRate(statistic, Normals, 0.0, 0.0), 0.104);
    EXPECT_LE(RejectionRate(statistic, Exponentials, 1.0, 1.0), 0.104);
  }
}

TEST(Predictive, WrongPoolIsFound) {
  EXPECT_GT(RejectionRate(MeanOf, Normals, 0.0, 0.7), 0.9);
  EXPECT_GT(RejectionRate(FrontOf, Normals, 0.0, 2.0), 0.8);
}

// Negative control: without the pool's own uncertainty a small pool gives false alarms.
TEST(Predictive, IgnoringThePoolsUncertaintyWouldGiveFalseAlarms) {
  constexpr std::uint32_t kPairs = 300;
  int rejected = 0;
  for (std::uint32_t pair = 0; pair < kPairs; ++pair) {
    const std::vector<double> pool = Normals(2 * pair, 20, 0.0);
    std::vector<double> drawn(400);
    for (std::uint32_t b = 0; b < drawn.size(); ++b) {
      core::RandomStream stream({.seed = 9, .trial = pair}, core::Purpose::kTest, b);
      double sum = 0.0;
      for (int i = 0; i < 40; ++i) sum += pool[static_cast<std::size_t>(stream.Uniform() * 20.0)];
      drawn[b] = sum / 40.0;
    }
    std::sort(drawn.begin(), drawn.end());
    const double published = MeanOf(Normals(2 * pair + 1, 40, 0.0));
    rejected += PredictivePValue(drawn, published, 0.0) <= 0.05 ? 1 : 0;
  }
  EXPECT_GT(rejected, 0.15 * kPairs);
}

TEST(Predictive, RoundedValuesCountOnBothSides) {
  const std::vector<double> drawn = {1.0, 2.0, 3.0, 4.0};
  EXPECT_DOUBLE_EQ(PredictivePValue(drawn, 1.6, 0.0), 2.0 * 2.0 / 5.0);
  EXPECT_DOUBLE_EQ(PredictivePValue(drawn, 1.6, 1.0), 1.0);
}

TEST(Predictive, ShiftPowerRisesWithTheShift) {
  const PredictiveSampler sampler(Normals(5, 300, 0.0));
  auto means = PredictiveStatistics(sampler, 40, MeanOf, 2000, {.seed = 1, .trial = 0});
  std::sort(means.begin(), means.end());
  EXPECT_LT(ShiftPower(means, 0.0, 0.05), 0.07);
  EXPECT_GT(ShiftPower(means, 0.8, 0.05), 0.95);
}

}  // namespace
}  // namespace rockyard::statistics
