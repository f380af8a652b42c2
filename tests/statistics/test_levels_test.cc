// Levels of the exact tests of two samples: how often they reject what is true.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "statistics/kolmogorov.h"
#include "statistics/proportions.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

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
