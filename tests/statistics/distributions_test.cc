#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "oracles.h"
#include "statistics/kolmogorov.h"
#include "statistics/multiple_testing.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Moments, EqualOraclesWholeAndMerged) {
  for (const core::JsonMember& oracle : At(Oracles(), "moments").members()) {
    const std::vector<double> sample = OracleSample(oracle.key);
    Moments parts[3];
    for (std::size_t i = 0; i < sample.size(); ++i) parts[i % 3].Add(sample[i]);
    Moments merged;
    for (const Moments& part : parts) merged.Merge(part);
    for (const Moments& m : {MomentsOf(sample), merged}) {
      EXPECT_EQ(m.count(), At(oracle.value, "n").integer());
      EXPECT_NEAR(m.mean(), At(oracle.value, "mean").number(), 1e-12);
      EXPECT_NEAR(m.standard_deviation(), At(oracle.value, "sd_ddof1").number(), 1e-12);
    }
    const std::vector<double> sorted = SortedFinite(sample);
    EXPECT_NEAR(Quantile(sorted, 0.5), At(oracle.value, "median").number(), 1e-12);
    EXPECT_NEAR(Quantile(sorted, 0.25), At(oracle.value, "q25_linear").number(), 1e-12);
    EXPECT_NEAR(Quantile(sorted, 0.95), At(oracle.value, "q95_linear").number(), 1e-12);
  }
}

TEST(Moments, LeaveOutWhatIsNotFiniteAndSurviveNothing) {
  const Moments m = MomentsOf(std::vector{1.0, kNaN, 3.0, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(m.count(), 2);
  EXPECT_EQ(m.not_finite(), 2);
  EXPECT_EQ(m.mean(), 2.0);
  EXPECT_EQ(m.min(), 1.0);
  EXPECT_EQ(m.max(), 3.0);
  EXPECT_TRUE(std::isnan(Moments().mean()));
  EXPECT_TRUE(std::isnan(MomentsOf(std::vector{4.0}).variance()));
  Moments with_fault = MomentsOf(std::vector{kNaN});
  with_fault.Merge(m);
  EXPECT_EQ(with_fault.not_finite(), 3);
  EXPECT_EQ(with_fault.mean(), 2.0);
}

TEST(Quantile, EndsTiesAndNothing) {
  const std::vector<double> sorted = {1.0, 2.0, 2.0, 5.0};
  EXPECT_EQ(Quantile(sorted, 0.0), 1.0);
  EXPECT_EQ(Quantile(sorted, 1.0), 5.0);
  EXPECT_EQ(Quantile(sorted, 0.5), 2.0);
  EXPECT_TRUE(std::isnan(Quantile({}, 0.5)));
}

TEST(Ecdf, StepsAndBands) {
  const auto points = Ecdf(std::vector{2.0, 1.0, 2.0, kNaN, 4.0});
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[1].value, 2.0);
  EXPECT_EQ(points[1].fraction, 0.75);
  // Half width sqrt(ln(2/0.05) / (2 n)).
  const auto large = Ecdf(OracleSample("b"));
  const double half = std::sqrt(std::log(40.0) / 600.0);
  EXPECT_NEAR(large[150].band.high - large[150].fraction, half, 1e-12);
  const auto pointwise = Ecdf(OracleSample("b"), 0.95, BandMethod::kPointwise);
  EXPECT_LT(pointwise[150].band.high - pointwise[150].fraction, half);
  EXPECT_TRUE(Ecdf({}).empty());
}

TEST(KolmogorovSmirnov, TwoSampleEqualsOracles) {
  const auto a = OracleSample("a");
  const std::span<const double> span(a);
  const auto b = OracleSample("b");
  const auto c = OracleSample("c");
  const TestResult results[] = {KolmogorovSmirnov(a, b), KolmogorovSmirnov(a, c),
                                KolmogorovSmirnov(span.first(12), span.subspan(12))};
  const auto& oracles = At(At(Oracles(), "ks"), "two_sample").list();
  for (std::size_t i = 0; i < 3; ++i) {
    const core::JsonValue& exact = oracles[2 * i];
    ASSERT_EQ(At(exact, "method").text(), "exact");
    EXPECT_NEAR(results[i].statistic, At(exact, "D").number(), 1e-12);
    EXPECT_NEAR(results[i].p_value, At(exact, "p").number(), 1e-9);
  }
}

TEST(KolmogorovSmirnov, OneSampleEqualsOracles) {
  const auto& oracles = At(At(Oracles(), "ks"), "one_sample").list();
  const auto expect = [&](const char* name, const TestResult& result) {
    for (const core::JsonValue& oracle : oracles) {
      if (At(oracle, "name").text() != name || At(oracle, "method").text() != "exact") continue;
      EXPECT_NEAR(result.statistic, At(oracle, "D").number(), 1e-12) << name;
      EXPECT_NEAR(result.p_value, At(oracle, "p").number(), 1e-9) << name;
      return;
    }
    FAIL() << name;
  };
  expect("a vs shifted exponential(7.6,.79)", KolmogorovSmirnov(OracleSample("a"), [](double x) {
           return x < 7.6 ? 0.0 : 1.0 - std::exp(-(x - 7.6) / 0.79);
         }));
  const auto normal = [](double mean) {
    return [mean](double x) { return boost::math::cdf(boost::math::normal(mean, 1.0), x); };
  };
  expect("d vs N(0,1)", KolmogorovSmirnov(OracleSample("d"), normal(0.0)));
  expect("d vs N(.3,1)", KolmogorovSmirnov(OracleSample("d"), normal(0.3)));
}

TEST(KolmogorovSmirnov, CriticalValuesAndLimitLaw) {
  for (const auto& c : At(At(Oracles(), "ks"), "critical_D_one_sample_exact_alpha05").members()) {
    const int n = std::stoi(c.key);
    // Beyond n = 140 SciPy itself falls back on Pelz and Good's series.
    EXPECT_NEAR(KolmogorovExactPValue(c.value.number(), n), 0.05, n > 140 ? 1e-6 : 1e-9);
  }
  for (const auto& c : At(At(Oracles(), "ks"), "kolmogorov_limit_sf").members()) {
    EXPECT_NEAR(KolmogorovLimitPValue(std::stod(c.key)), c.value.number(), 1e-12) << c.key;
  }
  EXPECT_EQ(KolmogorovExactPValue(0.001, 40), 1.0);
  EXPECT_EQ(KolmogorovExactPValue(1.0, 40), 0.0);
  EXPECT_EQ(KolmogorovSmirnov(std::span<const double>(), std::span<const double>()).p_value, 1.0);
}

TEST(Modes, FindThePeakAndSurviveSmallSamples) {
  const std::vector<double> sorted = {0.0, 1.0, 4.0, 4.1, 4.2, 4.3, 9.0, 12.0};
  EXPECT_NEAR(HalfSampleMode(sorted), 4.15, 0.11);
  EXPECT_NEAR(KernelMode(sorted), 4.1, 0.5);
  EXPECT_NEAR(HistogramMode(sorted), 4.1, 1.5);
  for (const auto mode : {HalfSampleMode, HistogramMode, KernelMode}) {
    EXPECT_TRUE(std::isnan(mode({})));
    EXPECT_EQ(mode(std::vector{3.0}), 3.0);
    EXPECT_EQ(mode(std::vector{3.0, 3.0, 3.0, 3.0, 3.0}), 3.0);
    const double two = mode(std::vector{1.0, 2.0});
    EXPECT_GE(two, 1.0);
    EXPECT_LE(two, 2.0);
  }
  // Hand-worked: of three left, the mean of the nearer pair.
  EXPECT_DOUBLE_EQ(HalfSampleMode(std::vector{1.0, 2.0, 4.0}), 1.5);
  EXPECT_DOUBLE_EQ(HalfSampleMode(std::vector{1.0, 3.0, 4.0}), 3.5);
  EXPECT_DOUBLE_EQ(HalfSampleMode(std::vector{1.0, 2.0, 3.0}), 2.0);
}

// Two peaks: blocks of 100 of 1000 values (1000^(2/3)) find one or the other.
TEST(Modes, RangeBySubsamplingSpansWhereTheModeJumps) {
  std::vector<double> two_peaks;
  std::vector<double> one_peak;
  for (int i = 0; i < 1000; ++i) {
    const double fraction = std::fmod(i * 0.6180339887498949, 1.0);
    one_peak.push_back(fraction * fraction * fraction);
    two_peaks.push_back((i / 100 % 2 == 0 ? 0.0 : 10.0) + 0.1 * fraction * fraction);
  }
  const Interval narrow = HalfSampleModeRange(one_peak);
  EXPECT_LT(narrow.high - narrow.low, 0.1);
  const Interval wide = HalfSampleModeRange(two_peaks);
  // A jump of 10 at a tenth of the values, shrunk by 0.1^(1/3).
  EXPECT_NEAR(wide.high - wide.low, 10.0 * std::cbrt(0.1), 0.5);
  std::vector<double> few(29, 1.0);
  EXPECT_TRUE(std::isnan(HalfSampleModeRange(few).low));
  few.push_back(1.0);
  EXPECT_EQ(HalfSampleModeRange(few).low, 1.0);
  EXPECT_EQ(HalfSampleModeRange(few).high, 1.0);
}

// The last tenth of 100000 values has another mode: only blocks that reach the end can know, and
// only blocks of no more than 1000 leave one in ten to say so.
TEST(Modes, RangeBySubsamplingLooksAtAllOfTheValues) {
  std::vector<double> values;
  for (int i = 0; i < 100000; ++i) {
    const double fraction = std::fmod(i * 0.6180339887498949, 1.0);
    values.push_back((i < 90000 ? 0.0 : 10.0) + 0.1 * fraction * fraction);
  }
  const Interval range = HalfSampleModeRange(values);
  // Below by the jump of 10, shrunk by (1000 / 100000)^(1/3).
  EXPECT_NEAR(range.low, -10.0 * std::cbrt(0.01), 0.1);
}

// Values that grow far out on one side: a mode of blocks above that of all puts the law's below.
TEST(Modes, RangeBySubsamplingMirrorsTheOffsets) {
  std::vector<double> values(90, 0.0);
  for (std::size_t i = 0; i < 40; ++i) values[50 + i] = 8.0;
  const Interval range = HalfSampleModeRange(values);
  EXPECT_LT(range.low, -4.0);
  EXPECT_NEAR(range.high, 0.0, 1e-9);
}

TEST(Holm, HandWorked) {
  const std::vector<double> p = {0.01, 0.04, 0.03, 0.005};
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  const std::vector<double> adjusted = HolmAdjust(p);
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_DOUBLE_EQ(adjusted[i], expected[i]);
  EXPECT_TRUE(HolmAdjust({}).empty());
}

TEST(Holm, LevelIsWhereTheVerdictTurns) {
  std::vector<double> p = {0.001, 0.5, 0.02, 0.9};
  for (std::size_t i = 0; i < p.size(); ++i) {
    std::vector<double> changed = p;
    const double level = HolmLevels(p, 0.05)[i];
    changed[i] = level * (1.0 - 1e-9);
    EXPECT_LE(HolmAdjust(changed)[i], 0.05);
    changed[i] = level * (1.0 + 1e-9);
    EXPECT_GT(HolmAdjust(changed)[i], 0.05);
  }
}

// One by one, as the procedure is defined: step down the others.
double LevelByDefinition(std::vector<double> others, std::size_t index, double alpha) {
  const auto family = static_cast<double>(others.size());
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
  std::sort(others.begin(), others.end());
  double rejected = 0.0;
  for (const double p : others) {
    if (p > alpha / (family - rejected)) break;
    rejected += 1.0;
  }
  return alpha / (family - rejected);
}

// Families in which none, some or all are rejected, with ties and values that are rejected only
// after another one has left.
TEST(Holm, LevelsOfAllAtOnceAreThoseOneByOne) {
  core::RandomStream stream({.seed = 6, .trial = 1}, core::Purpose::kTest);
  for (int family = 0; family < 2000; ++family) {
    std::vector<double> p(static_cast<std::size_t>(1 + family % 12));
    const double spread = 0.01 + 0.2 * stream.Uniform();
    for (double& value : p) value = std::round(1000.0 * spread * stream.Uniform()) / 1000.0;
    const std::vector<double> levels = HolmLevels(p, 0.05);
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_EQ(levels[i], LevelByDefinition(p, i, 0.05)) << family << " " << i;
    }
  }
  EXPECT_TRUE(HolmLevels({}, 0.05).empty());
}

}  // namespace
}  // namespace rockyard::statistics
