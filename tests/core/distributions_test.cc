// Every sampler against its distribution, and the same test against a slightly wrong distribution,
// which it must reject.

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/exponential.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <limits>
#include <numbers>

#include "core/normal_pieces.h"
#include "core/random.h"
#include "core/statistical_checks.h"

namespace rockyard::core {
namespace {

// Chance of a false alarm of each test if its seed were drawn anew. Seeds are fixed.
constexpr double kAlpha = 1e-4;
constexpr int kDraws = 100000;

std::vector<double> Draw(const std::function<double(RandomStream&)>& sampler,
                         std::uint32_t substream) {
  RandomStream stream({20260101, 0}, Purpose::kTest, substream);
  std::vector<double> sample(kDraws);
  for (double& value : sample) value = sampler(stream);
  return sample;
}

TEST(DistributionsTest, Uniform) {
  const auto sample = Draw([](RandomStream& s) { return SampleUniform(s, -2.0, 3.0); }, 1);
  EXPECT_GT(KolmogorovP(sample, [](double x) { return (x + 2.0) / 5.0; }), kAlpha);
  // Negative control: a range 2 % wider.
  EXPECT_LT(KolmogorovP(sample, [](double x) { return (x + 2.0) / 5.1; }), kAlpha);
}

// A probability may be as small as numbers get: what never happens has its quantile, too.
TEST(DistributionsTest, NormalQuantilesOfTheLeastProbabilities) {
  const boost::math::normal_distribution<long double> normal;
  for (const double p : {5e-324, 1e-310, 1e-300, 1e-100, 1e-17, 1.3e-11, 1.4e-11, 1e-3, 0.07}) {
    const auto right = static_cast<double>(quantile(normal, static_cast<long double>(p)));
    EXPECT_NEAR(NormalQuantile(p), right, -1e-15 * right) << p;
  }
  EXPECT_EQ(NormalQuantile(0.5), 0.0);
  EXPECT_EQ(NormalQuantile(0.25), -NormalQuantile(0.75));
}

TEST(DistributionsTest, Normal) {
  const auto sample = Draw([](RandomStream& s) { return SampleNormal(s, 1.0, 2.0); }, 2);
  const auto cdf_of = [](double mean, double deviation) {
    return [distribution = boost::math::normal(mean, deviation)](double x) {
      return boost::math::cdf(distribution, x);
    };
  };
  EXPECT_GT(KolmogorovP(sample, cdf_of(1.0, 2.0)), kAlpha);
  // Negative controls: 5 % wider, and shifted by 2 % of a standard deviation.
  EXPECT_LT(KolmogorovP(sample, cdf_of(1.0, 2.1)), kAlpha);
  EXPECT_LT(KolmogorovP(sample, cdf_of(1.04, 2.0)), kAlpha);
}

// Double precision gives the inverse to a few units in the last place, in the far tails too.
TEST(DistributionsTest, NormalIsTheInverseOfTheDistribution) {
  double worst = 0.0;
  for (std::uint32_t substream = 0; substream < 20000; ++substream) {
    RandomStream uniform({5, 0}, Purpose::kTest, substream);
    RandomStream normal({5, 0}, Purpose::kTest, substream);
    const long double u = uniform.Uniform();
    const long double exact =
        std::numbers::sqrt2_v<long double> * boost::math::erf_inv(2.0L * u - 1.0L);
    const auto error = static_cast<double>(SampleNormal(normal, 0.0, 1.0) - exact);
    worst = std::max(worst, std::abs(error) / static_cast<double>(std::abs(exact)));
  }
  EXPECT_LT(worst, 4.0 * std::numeric_limits<double>::epsilon());
  EXPECT_GT(worst, 0.0);
}

// Both ends, the middle and numbers on both sides of each border of pieces, by the slow inverse.
TEST(DistributionsTest, PiecesOfTheNormalInverseMeet) {
  constexpr int kPerOctave = 16;
  const NormalPieces pieces;
  double worst = 0.0;
  for (double octave = NormalPieces::kLeast; octave < 0.5; octave *= 2.0) {
    for (int part = 0; part < kPerOctave; ++part) {
      const double low = octave * (1.0 + static_cast<double>(part) / kPerOctave);
      const double high = octave * (1.0 + static_cast<double>(part + 1) / kPerOctave);
      for (const double t : {low, 0.5 * (low + high), std::nextafter(high, 0.0)}) {
        const double exact = -NormalQuantile(t);
        worst = std::max(worst, std::abs(pieces.Exceeded(t) - exact) / exact);
      }
    }
  }
  EXPECT_LT(worst, 4.0 * std::numeric_limits<double>::epsilon());
  EXPECT_GT(worst, 0.0);
}

TEST(DistributionsTest, NormalTails) {
  const auto sample = Draw([](RandomStream& s) { return SampleNormal(s, 0.0, 1.0); }, 3);
  const boost::math::normal distribution;
  std::vector<double> observed(8, 0.0);
  std::vector<double> expected;
  const std::vector<double> edges = {-3.0, -2.5, -2.0, 0.0, 2.0, 2.5, 3.0};
  double below = 0.0;
  for (const double edge : edges) {
    expected.push_back(kDraws * (cdf(distribution, edge) - below));
    below = cdf(distribution, edge);
  }
  expected.push_back(kDraws * (1.0 - below));
  // Negative control: a scaled sum of six uniforms has thin tails.
  std::vector<double> thin(8, 0.0);
  const auto sum = Draw(
      [](RandomStream& s) {
        double total = -3.0;
        for (int i = 0; i < 6; ++i) total += s.Uniform();
        return std::numbers::sqrt2 * total;
      },
      4);
  const auto bin = [&edges](double x) {
    return static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), x) -
                                    edges.begin());
  };
  for (const double x : sample) observed[bin(x)] += 1.0;
  for (const double x : sum) thin[bin(x)] += 1.0;
  EXPECT_GT(ChiSquareP(observed, expected), kAlpha);
  EXPECT_LT(ChiSquareP(thin, expected), kAlpha);
}

TEST(DistributionsTest, Exponential) {
  const auto sample = Draw([](RandomStream& s) { return SampleExponential(s, 0.4); }, 5);
  const auto cdf_of = [](double mean) {
    return [distribution = boost::math::exponential(1.0 / mean)](double x) {
      return boost::math::cdf(distribution, x);
    };
  };
  EXPECT_GT(KolmogorovP(sample, cdf_of(0.4)), kAlpha);
  EXPECT_LT(KolmogorovP(sample, cdf_of(0.41)), kAlpha);
}

TEST(DistributionsTest, Bernoulli) {
  for (const double probability : {0.01, 0.3, 0.94}) {
    const auto sample = Draw(
        [probability](RandomStream& s) { return SampleBernoulli(s, probability) ? 1.0 : 0.0; }, 6);
    double successes = 0.0;
    for (const double value : sample) successes += value;
    const std::vector<double> observed = {successes, kDraws - successes};
    const auto p_against = [&observed](double p) {
      return ChiSquareP(observed, {kDraws * p, kDraws * (1.0 - p)});
    };
    EXPECT_GT(p_against(probability), kAlpha) << probability;
    EXPECT_LT(p_against(probability + 0.01), kAlpha) << probability;
  }
  RandomStream stream({1, 1}, Purpose::kTest);
  EXPECT_FALSE(SampleBernoulli(stream, 0.0));
  EXPECT_TRUE(SampleBernoulli(stream, 1.0));
}

// p-value of counts against a Poisson law, in bins of at least 20 expected draws.
double PoissonP(const std::vector<double>& counts, double mean) {
  const boost::math::poisson distribution(mean);
  const auto draws = static_cast<double>(counts.size());
  std::vector<double> upper;  // last count of each bin but the last
  std::vector<double> expected;
  double below = 0.0;
  for (double k = 0.0; draws * (1.0 - cdf(distribution, k)) >= 20.0; k += 1.0) {
    const double up_to = cdf(distribution, k);
    if (draws * (up_to - below) < 20.0) continue;
    upper.push_back(k);
    expected.push_back(draws * (up_to - below));
    below = up_to;
  }
  expected.push_back(draws * (1.0 - below));
  std::vector<double> observed(expected.size(), 0.0);
  for (const double count : counts) {
    const auto bin = std::lower_bound(upper.begin(), upper.end(), count) - upper.begin();
    observed[static_cast<std::size_t>(bin)] += 1.0;
  }
  return ChiSquareP(observed, expected);
}

class PoissonTest : public testing::TestWithParam<double> {};

TEST_P(PoissonTest, CountsFollowTheLaw) {
  const double mean = GetParam();
  auto counts =
      Draw([mean](RandomStream& s) { return static_cast<double>(SamplePoisson(s, mean)); }, 7);
  EXPECT_GT(PoissonP(counts, mean), kAlpha);
  // Negative controls: a mean that is off by 3 % of a standard deviation and 1 %, and the rounded
  // normal law of the same mean and variance.
  EXPECT_LT(PoissonP(counts, mean * 1.01 + 0.03 * std::sqrt(mean)), kAlpha);
  if (mean < 100.0) {
    const auto rounded = Draw(
        [mean](RandomStream& s) {
          return std::max(0.0, std::round(SampleNormal(s, mean, std::sqrt(mean))));
        },
        8);
    EXPECT_LT(PoissonP(rounded, mean), kAlpha);
  }
}

// 200 is the largest mean inverted at once; above it, counts are sums.
INSTANTIATE_TEST_SUITE_P(Means, PoissonTest, testing::Values(0.3, 5.0, 60.0, 200.0, 200.5, 1000.0));

TEST(DistributionsTest, PoissonOfNothingIsNothing) {
  RandomStream stream({1, 1}, Purpose::kTest);
  EXPECT_EQ(SamplePoisson(stream, 0.0), 0);
}

TEST(ChiSquaredQuantile, IsThatOfTheTables) {
  EXPECT_NEAR(ChiSquaredQuantile(0.95, 1), 3.8415, 1e-4);
  EXPECT_NEAR(ChiSquaredQuantile(0.95, 3), 7.8147, 1e-4);
  EXPECT_NEAR(ChiSquaredQuantile(0.05, 3), 0.3518, 1e-4);
}

// Two degrees of freedom are an exponential distribution of mean 2.
TEST(ChiSquaredQuantile, HasAClosedFormForTwo) {
  for (const double p : {0.0, 0.1, 0.5, 0.999}) {
    EXPECT_NEAR(ChiSquaredQuantile(p, 2), -2.0 * std::log1p(-p), 1e-10);
  }
}

TEST(ChiSquaredQuantile, IsThatOfBoost) {
  for (const int degrees : {1, 2, 3, 4, 5, 6, 7, 120, 2401}) {
    const boost::math::chi_squared_distribution<long double> law(degrees);
    for (const double p : {1e-4, 0.05, 0.5, 0.95, 0.999}) {
      const auto right = static_cast<double>(quantile(law, static_cast<long double>(p)));
      EXPECT_NEAR(ChiSquaredQuantile(p, degrees), right, 1e-10 * right) << degrees << " " << p;
    }
  }
}

// Streams whose names differ in one part are independent: joint cell counts of pairs, chi-square.

constexpr double kAlphaOfPairs = 1e-4;
constexpr int kPairs = 100000;
constexpr std::size_t kSide = 16;

template <typename NextPair>
double JointP(NextPair next_pair) {
  std::vector<double> observed(kSide * kSide, 0.0);
  for (int i = 0; i < kPairs; ++i) {
    const auto [a, b] = next_pair(static_cast<std::uint32_t>(i));
    const auto row = static_cast<std::size_t>(a * kSide);
    const auto column = static_cast<std::size_t>(b * kSide);
    observed[row * kSide + column] += 1.0;
  }
  return ChiSquareP(observed, std::vector<double>(kSide * kSide, kPairs / double{kSide * kSide}));
}

double JointOf(RandomStream a, RandomStream b) {
  return JointP([&](std::uint32_t) { return std::pair(a.Uniform(), b.Uniform()); });
}

TEST(IndependenceTest, StreamsThatDifferInOnePartOfTheirName) {
  const RandomStream stream({1, 1}, Purpose::kGyro, 1);
  EXPECT_GT(JointOf(stream, RandomStream({2, 1}, Purpose::kGyro, 1)), kAlphaOfPairs);
  EXPECT_GT(JointOf(stream, RandomStream({1, 2}, Purpose::kGyro, 1)), kAlphaOfPairs);
  EXPECT_GT(JointOf(stream, RandomStream({1, 1}, Purpose::kEncoder, 1)), kAlphaOfPairs);
  EXPECT_GT(JointOf(stream, RandomStream({1, 1}, Purpose::kGyro, 2)), kAlphaOfPairs);
}

TEST(IndependenceTest, NegativeControlAStreamDependsOnItself) {
  const RandomStream stream({1, 1}, Purpose::kGyro, 1);
  EXPECT_LT(JointOf(stream, stream), kAlphaOfPairs);
}

// How noise is used: one short stream per scan.
TEST(IndependenceTest, FirstNumbersOfNeighbouringSubstreams) {
  EXPECT_GT(JointP([](std::uint32_t i) {
              RandomStream a({3, 0}, Purpose::kStripeMissed, 2 * i);
              RandomStream b({3, 0}, Purpose::kStripeMissed, 2 * i + 1);
              return std::pair(a.Uniform(), b.Uniform());
            }),
            kAlphaOfPairs);
}

// Negative control: numbers that grow with the name's number instead of being scrambled by it.
TEST(IndependenceTest, NegativeControlWeylSequence) {
  constexpr double kGoldenRatio = 0.61803398874989485;
  EXPECT_LT(JointP([](std::uint32_t i) {
              const double a = std::fmod(2.0 * i * kGoldenRatio, 1.0);
              const double b = std::fmod((2.0 * i + 1.0) * kGoldenRatio, 1.0);
              return std::pair(a, b);
            }),
            kAlphaOfPairs);
}

TEST(IndependenceTest, FirstNumbersOfNeighbouringTrials) {
  EXPECT_GT(JointP([](std::uint32_t i) {
              RandomStream a({3, 2 * i}, Purpose::kRockCount);
              RandomStream b({3, 2 * i + 1}, Purpose::kRockCount);
              return std::pair(a.Uniform(), b.Uniform());
            }),
            kAlphaOfPairs);
}

TEST(IndependenceTest, ConsecutiveNumbersOfOneStream) {
  RandomStream stream({4, 0}, Purpose::kTest);
  EXPECT_GT(JointP([&](std::uint32_t) {
              const double first = stream.Uniform();
              return std::pair(first, stream.Uniform());
            }),
            kAlphaOfPairs);
}

}  // namespace
}  // namespace rockyard::core
