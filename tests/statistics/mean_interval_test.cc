// Intervals of means: closed forms, when there is none, and coverage of a skewed law.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "statistics/equivalence.h"
#include "statistics/kolmogorov.h"
#include "statistics/metrics.h"
#include "statistics/proportions.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

constexpr double kT39 = 2.0226909200367604;  // 0.975 quantile of Student's law, 39 degrees (scipy)

std::vector<double> Ascending(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

// Values exp(sigma z) - 1 or so at evenly spread quantiles: `bend` 0 is symmetric.
std::vector<double> Bent(double bend) {
  std::vector<double> values;
  for (int i = 0; i < 40; ++i) {
    const double x = (i - 19.5) / 20.0;
    values.push_back(x + bend * x * x);
  }
  return Ascending(values);
}

// Skewness over the root of n, each sum by itself.
double SkewOverRoot(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double x : values) mean += x / n;
  double squares = 0.0;
  double cubes = 0.0;
  for (const double x : values) {
    squares += std::pow(x - mean, 2.0);
    cubes += std::pow(x - mean, 3.0);
  }
  // G1 = sqrt(n (n - 1)) / (n - 2) m3 / m2^1.5.
  const double g = (cubes / n) / std::pow(squares / n, 1.5);
  return std::sqrt(n * (n - 1.0)) / (n - 2.0) * g / std::sqrt(n);
}

double HallOf(double t, double r) {
  return t + r * t * t / 3.0 + r * r * t * t * t / 27.0 + r / 6.0;
}

struct Distances {
  double below;  // of the ends from the mean, in standard errors
  double above;
};

Distances DistancesOf(const std::vector<double>& values) {
  const Interval interval = SkewedMeanInterval(values);
  const Moments moments = MomentsOf(values);
  const double error = moments.standard_deviation() / std::sqrt(static_cast<double>(values.size()));
  return {(moments.mean() - interval.low) / error, (interval.high - moments.mean()) / error};
}

TEST(SkewedMeanInterval, OfSymmetricValuesIsStudents) {
  const Distances ends = DistancesOf(Bent(0.0));
  EXPECT_NEAR(ends.below, kT39, 1e-9);
  EXPECT_NEAR(ends.above, kT39, 1e-9);
}

// No skewness at all: the formula of the inverse is 0 / 0.
TEST(SkewedMeanInterval, OfTwoValuesIsStudents) {
  const Interval interval = SkewedMeanInterval(std::vector{-1.0, 1.0});
  EXPECT_NEAR(interval.high, 12.706204736432095, 1e-9);  // one degree, standard error 1 (scipy)
  EXPECT_NEAR(interval.low, -12.706204736432095, 1e-9);
}

TEST(SkewedMeanInterval, FarEndIsHallsAndNearEndStudents) {
  const std::vector<double> values = Bent(0.4);
  const double r = 2.0 * SkewOverRoot(values);
  ASSERT_GT(r, 0.05);
  const Distances ends = DistancesOf(values);
  EXPECT_NEAR(ends.below, kT39, 1e-9);
  EXPECT_GT(ends.above, kT39 + 0.01);
  // The mean is at the upper end where Student's statistic is -above.
  EXPECT_NEAR(HallOf(-ends.above, r), -kT39, 1e-9);
}

TEST(SkewedMeanInterval, IsMirroredWithTheValues) {
  std::vector<double> values = Bent(0.4);
  const Distances ends = DistancesOf(values);
  for (double& x : values) x = 7.0 - 3.0 * x;
  const Distances mirrored = DistancesOf(Ascending(values));
  EXPECT_NEAR(mirrored.below, ends.above, 1e-9);
  EXPECT_NEAR(mirrored.above, ends.below, 1e-9);
}

TEST(SkewedMeanInterval, EndsAreNoFurtherThanOneAndThreeQuartersOfStudents) {
  std::vector<double> values(40, 0.0);
  values.back() = 1.0;
  const Distances ends = DistancesOf(values);
  EXPECT_NEAR(ends.below, kT39, 1e-9);
  EXPECT_NEAR(ends.above, 1.75 * kT39, 1e-9);
}

std::vector<double> Zeros(std::size_t zeros, std::size_t others) {
  std::vector<double> values(zeros, 0.0);
  for (std::size_t i = 0; i < others; ++i) values.push_back(1.0 + static_cast<double>(i));
  return values;
}

// 0 of 40: 1 - 0.025^(1/40).
TEST(EstimateMean, WithoutAnyEventThereIsAShareAndNoInterval) {
  const MeanEstimate none = EstimateMean(Zeros(40, 0));
  EXPECT_EQ(none.lack, MeanLack::kNothingApart);
  EXPECT_TRUE(std::isnan(none.interval.low));
  EXPECT_TRUE(std::isnan(none.interval.high));
  EXPECT_EQ(none.usual, 0.0);
  EXPECT_EQ(none.apart.count, 0);
  EXPECT_NEAR(none.apart.interval.high, 1.0 - std::pow(0.025, 1.0 / 40.0), 1e-12);
}

TEST(EstimateMean, OfRareEventsThereIsAnIntervalFromTenOn) {
  const MeanEstimate nine = EstimateMean(Zeros(91, 9));
  EXPECT_EQ(nine.lack, MeanLack::kTooFewApart);
  EXPECT_EQ(nine.needs, 10);
  EXPECT_EQ(nine.apart.count, 9);
  EXPECT_EQ(nine.apart.trials, 100);
  EXPECT_TRUE(std::isnan(nine.interval.low));
  const Interval exact = ProportionInterval(9, 100, kConfidence, IntervalMethod::kClopperPearson);
  EXPECT_EQ(nine.apart.interval.low, exact.low);
  EXPECT_EQ(nine.apart.interval.high, exact.high);
  const MeanEstimate ten = EstimateMean(Zeros(90, 10));
  EXPECT_EQ(ten.lack, MeanLack::kNone);
  EXPECT_EQ(ten.interval.high, SkewedMeanInterval(Zeros(90, 10)).high);
}

TEST(EstimateMean, NeedsAsManyValuesAsTheirLawTakes) {
  const MeanEstimate few = EstimateMean(Zeros(0, 29));
  EXPECT_EQ(few.lack, MeanLack::kTooFewValues);
  EXPECT_EQ(few.needs, 30);
  EXPECT_EQ(EstimateMean(Zeros(0, 30)).lack, MeanLack::kNone);
  EXPECT_EQ(EstimateMean(Zeros(0, 99), 100).needs, 100);
  EXPECT_EQ(EstimateMean(Zeros(0, 5000), kNeverForMean).lack, MeanLack::kNoBound);
  EXPECT_EQ(EstimateMean({}).lack, MeanLack::kTooFewValues);
  EXPECT_TRUE(std::isnan(EstimateMean({}).usual));
}

TEST(EstimateMean, TheUsualValueIsTheCommonestAndOfSeveralTheLowest) {
  EXPECT_EQ(EstimateMean(std::vector{1.0, 2.0, 2.0, 3.0}).usual, 2.0);
  EXPECT_EQ(EstimateMean(std::vector{1.0, 1.0, 2.0, 2.0}).usual, 1.0);
  EXPECT_EQ(EstimateMean(std::vector{1.0, 2.0, 2.0, 3.0}).apart.count, 2);
}

TEST(MeanDifferenceInterval, AddsDistancesInSquares) {
  const Interval interval = MeanDifferenceInterval(10.0, {7.0, 14.0}, 20.0, {17.0, 32.0});
  EXPECT_DOUBLE_EQ(interval.low, 10.0 - 5.0);  // 3 below the second, 4 above the first
  EXPECT_NEAR(interval.high, 10.0 + std::hypot(12.0, 3.0), 1e-12);
  const double nan = std::nan("");
  EXPECT_TRUE(std::isnan(MeanDifferenceInterval(1.0, {nan, nan}, 2.0, {1.0, 3.0}).low));
}

TEST(FewestForMean, OfAColumnIsTheMostOfItsMetrics) {
  EXPECT_EQ(FewestForMean("max_tilt_deg"), kFewestForMean);
  EXPECT_EQ(FewestForMean("final_x_m"), kFewestForMean);
  EXPECT_EQ(FewestForMean("true_distance_m"), kFewestForMean) << "path_ratio divides it";
  EXPECT_EQ(FewestForMean("sim_time_s"), kFewestForMean);
  EXPECT_EQ(FewestForMean("active_time_s"), 40);
  EXPECT_EQ(FewestForMean("stops"), 300);
  EXPECT_EQ(FewestForMean("path_ratio"), 300);
  EXPECT_EQ(FewestForMean("distance_error_percent"), kNeverForMean);
}

// Log-normal values of skewness 6.2, mean exp(1/2), 40 each, 2000 samples. If the interval held the
// mean in 93 %, the count would fall below the bound with alpha 0.001; Student's interval is the
// control, and misses nearly always below.
TEST(SkewedMeanInterval, HoldsTheMeanOfASkewedLawWhereStudentsDoesNot) {
  constexpr int kSamples = 2000;
  const double truth = std::exp(0.5);
  int held = 0;
  int students = 0;
  int students_below = 0;
  for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
    core::RandomStream stream({.seed = 71, .trial = sample}, core::Purpose::kTest);
    std::vector<double> values(40);
    for (double& x : values) x = std::exp(core::SampleNormal(stream, 0.0, 1.0));
    const Interval interval = SkewedMeanInterval(values);
    held += interval.low <= truth && truth <= interval.high ? 1 : 0;
    const Interval student = DifferenceInterval(PairedMeans(values));
    students += student.low <= truth && truth <= student.high ? 1 : 0;
    students_below += student.high < truth ? 1 : 0;
  }
  const double bound = 0.93 * kSamples - 3.09 * std::sqrt(0.93 * 0.07 * kSamples);
  EXPECT_GT(held, bound);
  EXPECT_LT(students, bound);
  EXPECT_GT(students_below, 0.95 * (kSamples - students));
}

// Levels of the exact tests of two samples: how often they reject what is true.

// Chance that Fisher's test of two groups of n rejects at 0.05, summed over all tables.
double FisherLevel(std::int64_t n, double first, double second) {
  const CountLaw a = BinomialLaw(n, first);
  const CountLaw b = BinomialLaw(n, second);
  double level = 0.0;
  for (std::int64_t i = 0; i <= n; ++i) {
    for (std::int64_t j = 0; j <= n; ++j) {
      if (FisherExactPValue({i, n - i, j, n - j}) > 0.05) continue;
      level += a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(j)];
    }
  }
  return level;
}

TEST(FisherExact, KeepsItsLevelAndFindsADifference) {
  for (const double rate : {0.02, 0.2, 0.5, 0.9}) EXPECT_LE(FisherLevel(40, rate, rate), 0.05);
  EXPECT_GT(FisherLevel(40, 0.5, 0.85), 0.8);
}

// Discordant pairs fall either way like a coin.
TEST(McNemarExact, KeepsItsLevelAndFindsADifference) {
  const auto level = [](std::int64_t pairs, double share) {
    const CountLaw law = BinomialLaw(pairs, share);
    double sum = 0.0;
    for (std::int64_t k = 0; k <= pairs; ++k) {
      if (McNemarExactPValue(k, pairs - k) <= 0.05) sum += law[static_cast<std::size_t>(k)];
    }
    return sum;
  };
  for (const std::int64_t pairs : {5, 20, 61}) EXPECT_LE(level(pairs, 0.5), 0.05);
  EXPECT_GT(level(61, 0.75), 0.9);
}

// Simulated level of the two-sample test (n = m = 25; D >= 10/25 is critical, whose exact chance is
// the p-value that the test gives it), within 4 standard errors of 4000 pairs.
TEST(KolmogorovSmirnov, SimulatedLevelIsTheExactOne) {
  constexpr std::uint32_t kPairs = 4000;
  double largest = 0.0;  // p-value at or below 0.05: the level that the lattice of D allows
  int rejected = 0;
  int found = 0;
  for (std::uint32_t pair = 0; pair < kPairs; ++pair) {
    core::RandomStream stream({.seed = 91, .trial = pair}, core::Purpose::kTest);
    std::vector<double> a(25);
    std::vector<double> b(25);
    for (double& x : a) x = stream.Uniform();
    for (double& x : b) x = stream.Uniform();
    const double p = KolmogorovSmirnov(a, b).p_value;
    if (p <= 0.05) {
      ++rejected;
      largest = std::max(largest, p);
    }
    for (double& x : b) x += 0.5;
    found += KolmogorovSmirnov(a, b).p_value <= 0.05 ? 1 : 0;
  }
  const double error = std::sqrt(largest * (1.0 - largest) / kPairs);
  EXPECT_NEAR(static_cast<double>(rejected) / kPairs, largest, 4.0 * error);
  EXPECT_GT(found, 0.9 * kPairs);
}

// Share of 4000 samples of 50 uniform values whose band holds the true law at and before each step.
double BandCoverage(BandMethod method) {
  constexpr std::uint32_t kSamples = 4000;
  int held = 0;
  for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
    core::RandomStream stream({.seed = 92, .trial = sample}, core::Purpose::kTest);
    std::vector<double> values(50);
    for (double& x : values) x = stream.Uniform();
    const std::vector<EcdfPoint> curve = Ecdf(values, 0.95, method);
    bool all = true;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      const double law = curve[i].value;
      const Interval before = i == 0 ? Interval{0.0, 1.0} : curve[i - 1].band;
      all = all && law >= curve[i].band.low && law <= curve[i].band.high && law <= before.high;
    }
    held += all ? 1 : 0;
  }
  return static_cast<double>(held) / kSamples;
}

// The whole curve with at least 95 %: at most by the little that the bound gives away for 50 values
// (the exact chance of D_50 below it is 0.957), four standard errors of 4000 samples.
TEST(EcdfBand, HoldsTheWholeCurveAsOftenAsItSays) {
  const double error = std::sqrt(0.957 * 0.043 / 4000.0);
  const double coverage = BandCoverage(BandMethod::kSimultaneous);
  EXPECT_GT(coverage, 0.95 - 4.0 * error);
  EXPECT_LT(coverage, 0.98);
  EXPECT_LT(BandCoverage(BandMethod::kPointwise), 0.85) << "the control: each point alone";
}

}  // namespace
}  // namespace rockyard::statistics
