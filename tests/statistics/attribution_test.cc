// Known answers of factorial effects and Shapley shares.
#include "statistics/attribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/random.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

const std::vector<std::string> kFour{"designation", "localization", "detection", "path selection"};

// Failures of `trials` trials by a rule: does trial t fail with these functions perfect?
FactorialFailures Make(std::vector<std::string> functions, std::size_t trials,
                       const std::function<bool(Combination, std::size_t)>& fails) {
  FactorialFailures failures{std::move(functions), {}};
  failures.failed.resize(std::size_t{1} << failures.functions.size());
  for (Combination c = 0; c < failures.failed.size(); ++c) {
    for (std::size_t t = 0; t < trials; ++t) failures.failed[c].push_back(fails(c, t) ? 1 : 0);
  }
  return failures;
}

// Every trial has one cause of failure or none: 10 % designation, 20 % localization, 30 %
// detection, 5 % path selection.
bool FailsByItsOwnCause(Combination perfect, std::size_t t) {
  constexpr std::array<std::size_t, 5> kUpTo{0, 10, 30, 60, 65};
  for (std::size_t i = 0; i < 4; ++i) {
    if (t % 100 >= kUpTo[i] && t % 100 < kUpTo[i + 1]) return ((perfect >> i) & 1U) == 0;
  }
  return false;
}

// Any failures at all, for checks of identities.
FactorialFailures Arbitrary(std::size_t functions) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < functions; ++i) names.push_back(std::string(1, char('a' + i)));
  core::RandomStream stream({7, 3}, core::Purpose::kTest);
  return Make(names, 50, [&](Combination c, std::size_t) {
    return stream.Uniform() < 0.2 + 0.1 * std::popcount(c & 5U);
  });
}

double Rate(const FactorialFailures& failures, Combination c) {
  const auto& failed = failures.failed[c];
  return std::accumulate(failed.begin(), failed.end(), 0.0) / static_cast<double>(failed.size());
}

TEST(AttributionTest, SeparateCausesAreSharesAndEffectsAndSumUp) {
  const Attribution result = Attribute(Make(kFour, 200, FailsByItsOwnCause));
  const std::array<double, 4> expected{0.10, 0.20, 0.30, 0.05};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(result.shares[i].share.value, expected[i], 1e-12);
    EXPECT_NEAR(result.shares[i].first.value, expected[i], 1e-12);
    EXPECT_NEAR(result.shares[i].last.value, expected[i], 1e-12);
    EXPECT_NEAR(result.effects[i].effect.value, -expected[i], 1e-12);
  }
  for (std::size_t e = 4; e < result.effects.size(); ++e) {
    EXPECT_NEAR(result.effects[e].effect.value, 0.0, 1e-12) << e;
  }
  EXPECT_NEAR(result.removed.value, 0.65, 1e-12);
  EXPECT_NEAR(result.sum_of_firsts, 0.65, 1e-12);
  EXPECT_EQ(result.remainder.count, 0);
}

// Both have to be perfect: neither alone removes anything, and they share evenly.
TEST(AttributionTest, PureInteractionIsSharedEvenly) {
  const Attribution result = Attribute(
      Make({"a", "b"}, 40, [](Combination c, std::size_t t) { return t % 4 == 0 && c != 3U; }));
  EXPECT_EQ(result.shares[0].first.value, 0.0);
  EXPECT_EQ(result.sum_of_firsts, 0.0);
  EXPECT_NEAR(result.shares[0].share.value, 0.125, 1e-12);
  EXPECT_NEAR(result.shares[1].share.value, 0.125, 1e-12);
  EXPECT_NEAR(result.shares[0].last.value, 0.25, 1e-12);
  EXPECT_NEAR(result.removed.value, 0.25, 1e-12);
  // -(0.25 - 0) / 2: twice the failures go with both than each on its own would tell.
  EXPECT_NEAR(result.effects[2].effect.value, -0.125, 1e-12);
}

// Either is enough: alone each removes everything, so that the firsts sum to twice what there is.
TEST(AttributionTest, OneAtATimeEffectsNeedNotSum) {
  const Attribution result = Attribute(
      Make({"a", "b"}, 40, [](Combination c, std::size_t t) { return t % 4 == 0 && c == 0U; }));
  EXPECT_NEAR(result.sum_of_firsts, 0.5, 1e-12);
  EXPECT_NEAR(result.removed.value, 0.25, 1e-12);
  EXPECT_NEAR(result.shares[0].share.value, 0.125, 1e-12);
  EXPECT_EQ(result.shares[0].last.value, 0.0);
}

TEST(AttributionTest, SharesAreTheMeanOverAllOrders) {
  const FactorialFailures failures = Arbitrary(4);
  std::array<double, 4> shares{};
  std::array<std::size_t, 4> order{0, 1, 2, 3};
  int orders = 0;
  do {
    Combination perfect = 0;
    for (const std::size_t i : order) {
      const double before = Rate(failures, perfect);
      perfect |= Combination{1} << i;
      shares[i] += before - Rate(failures, perfect);
    }
    ++orders;
  } while (std::next_permutation(order.begin(), order.end()));
  ASSERT_EQ(orders, 24);
  const Attribution result = Attribute(failures);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(result.shares[i].share.value, shares[i] / orders, 1e-12);
    sum += result.shares[i].share.value;
  }
  EXPECT_NEAR(sum, result.removed.value, 1e-12);
  EXPECT_NEAR(result.removed.value + result.remainder.rate, result.failures[0].rate, 1e-12);
}

// Two functions that do the same have the same share; one that does nothing has none.
TEST(AttributionTest, SymmetricFunctionsShareAlikeAndIdleOnesHaveNothing) {
  const Attribution result =
      Attribute(Make({"a", "b", "idle"}, 60, [](Combination c, std::size_t t) {
        return t % 10 < 6 - 2 * static_cast<std::size_t>(std::popcount(c & 3U));
      }));
  EXPECT_NEAR(result.shares[0].share.value, result.shares[1].share.value, 1e-12);
  EXPECT_NEAR(result.shares[2].share.value, 0.0, 1e-12);
  EXPECT_GT(result.shares[0].share.value, 0.1);
}

TEST(AttributionTest, EffectsAndGrandMeanGiveEveryCombinationBack) {
  const FactorialFailures failures = Arbitrary(3);
  const Attribution result = Attribute(failures);
  double mean = 0.0;
  for (Combination c = 0; c < 8; ++c) mean += Rate(failures, c) / 8.0;
  for (Combination c = 0; c < 8; ++c) {
    double rate = mean;
    for (const EffectOfSet& row : result.effects) {
      const double sign = std::popcount(row.set & ~c) % 2 == 0 ? 1.0 : -1.0;
      rate += 0.5 * sign * row.effect.value;
    }
    EXPECT_NEAR(rate, Rate(failures, c), 1e-12) << c;
  }
}

// The percentile interval (Efron 1979), plainly, with one stream per replicate.
Interval BootstrapInterval(std::span<const double> sample,
                           const std::function<double(std::span<const double>)>& statistic,
                           std::uint64_t seed, double confidence = kConfidence,
                           std::size_t replicates = 2000) {
  const std::vector<double> values = SortedFinite(sample);
  std::vector<double> resample(values.size());
  std::vector<double> statistics(replicates);
  for (std::size_t b = 0; b < replicates; ++b) {
    core::RandomStream stream({.seed = seed, .trial = 0}, core::Purpose::kTest,
                              static_cast<std::uint32_t>(b));
    for (double& x : resample) {
      x = values[static_cast<std::size_t>(stream.Uniform() * static_cast<double>(values.size()))];
    }
    std::sort(resample.begin(), resample.end());
    statistics[b] = statistic(resample);
  }
  std::sort(statistics.begin(), statistics.end());
  const double tail = 0.5 * (1.0 - confidence);
  return {Quantile(statistics, tail), Quantile(statistics, 1.0 - tail)};
}

// A percentile bootstrap over trials estimates the same spread.
TEST(AttributionTest, IntervalsAgreeWithABootstrapOverTrials) {
  const FactorialFailures failures = Make(kFour, 400, FailsByItsOwnCause);
  const Contrast contrast = ShapleyShare(4, 2);
  std::vector<double> values;
  for (std::size_t t = 0; t < 400; ++t) {
    double value = 0.0;
    for (Combination c = 0; c < 16; ++c) value += contrast.weights[c] * failures.failed[c][t];
    values.push_back(value);
  }
  const Interval bootstrap = BootstrapInterval(
      values,
      [](std::span<const double> sample) {
        return std::accumulate(sample.begin(), sample.end(), 0.0) / 400.0;
      },
      1);
  const Estimate estimate = Estimated(failures, contrast);
  EXPECT_NEAR(estimate.interval.low, bootstrap.low, 0.006);
  EXPECT_NEAR(estimate.interval.high, bootstrap.high, 0.006);
}

TEST(AttributionTest, TrialsThatAllAgreeLeaveAnIntervalWithWidth) {
  const Attribution result =
      Attribute(Make({"a"}, 30, [](Combination, std::size_t) { return false; }));
  EXPECT_EQ(result.shares[0].share.value, 0.0);
  EXPECT_LT(result.shares[0].share.interval.low, -0.02);
  EXPECT_GT(result.shares[0].share.interval.high, 0.02);
}

TEST(AttributionTest, NoTrialsGiveNoEstimate) {
  const Attribution result =
      Attribute(Make({"a"}, 0, [](Combination, std::size_t) { return false; }));
  EXPECT_TRUE(std::isnan(result.shares[0].share.value));
  EXPECT_EQ(result.shares[0].share.interval.low, -1.0);
}

TEST(AttributionTest, CombinationsHaveNames) {
  EXPECT_EQ(NameOf(0, kFour), "as flown");
  EXPECT_EQ(NameOf(5, kFour), "designation x detection");
  EXPECT_EQ(NameOf(10, kFour, " + "), "localization + path selection");
}

}  // namespace
}  // namespace rockyard::statistics
