#include "statistics/equivalence.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/json_file.h"
#include "oracles.h"
#include "statistics/proportions.h"
#include "statistics/sample_size.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

// Numbers of scipy; the file names the functions.
const core::JsonValue& ScipyNumbers() {
  static const core::JsonValue oracles =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/equivalence_oracles.json");
  return oracles;
}

std::vector<double> Sample(std::string_view name) { return Numbers(At(ScipyNumbers(), name)); }

TEST(PairedMeans, EqualScipy) {
  const std::vector<double> a = Sample("a");
  const std::vector<double> c = Sample("c");
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(c[i] - a[i]);
  const MeanDifference means = PairedMeans(differences);
  const core::JsonValue& expected = At(ScipyNumbers(), "paired");
  EXPECT_NEAR(ChangePValue(means), At(expected, "p").number(), 1e-10);
  EXPECT_NEAR(EquivalencePValue(means, 0.5), At(expected, "tost_0.5").number(), 1e-10);
  EXPECT_NEAR(EquivalencePValue(means, 1.0), At(expected, "tost_1").number(), 1e-10);
  const Interval interval = DifferenceInterval(means, 0.9);
  EXPECT_NEAR(interval.low, Numbers(At(expected, "ci90"))[0], 1e-10);
  EXPECT_NEAR(interval.high, Numbers(At(expected, "ci90"))[1], 1e-10);
}

TEST(WelchMeans, EqualScipy) {
  const MeanDifference means = WelchMeans(Sample("a"), Sample("b"));
  const core::JsonValue& expected = At(ScipyNumbers(), "welch");
  EXPECT_NEAR(ChangePValue(means), At(expected, "p").number(), 1e-10);
  EXPECT_NEAR(EquivalencePValue(means, 1.0), At(expected, "tost_1").number(), 1e-10);
  EXPECT_NEAR(EquivalencePValue(means, 2.5), At(expected, "tost_2.5").number(), 1e-10);
}

TEST(MeanDifference, NoScatterAndNoValues) {
  const MeanDifference same = PairedMeans(std::vector<double>(5, 0.0));
  EXPECT_EQ(ChangePValue(same), 1.0);
  EXPECT_EQ(EquivalencePValue(same, 0.1), 1.0 / 32.0);
  const MeanDifference moved = PairedMeans(std::vector<double>(5, 0.2));
  EXPECT_EQ(ChangePValue(moved), 1.0 / 16.0) << "all five of one sign, either sign";
  EXPECT_EQ(EquivalencePValue(moved, 0.1), 1.0);
  // Of the 10 ways to part five values into three and two, two part these.
  const MeanDifference apart = WelchMeans(std::vector<double>(3, 0.0), std::vector<double>(2, 1.0));
  EXPECT_NEAR(ChangePValue(apart), 0.2, 1e-12);
  const MeanDifference unknown = PairedMeans(std::vector<double>{1.0});
  EXPECT_FALSE(unknown.known());
  EXPECT_EQ(ChangePValue(unknown), 1.0);
  EXPECT_EQ(EquivalencePValue(unknown, 1.0), 1.0);
}

// Without scatter about it the score interval has a closed form: with no discordant pair of n the
// variance is n delta (1 - delta), so that the end solves n delta = z^2 (1 - delta).
TEST(PairedRates, NoDiscordantPairInClosedForm) {
  const double square = 1.959963984540054 * 1.959963984540054;
  const Interval interval = DifferenceInterval(PairedCounts{.both = 30, .neither = 10}, 0.95);
  EXPECT_NEAR(interval.high, square / (40.0 + square), 1e-9);
  EXPECT_NEAR(interval.low, -interval.high, 1e-9);
}

// With no difference the score is McNemar's (c - b) / sqrt(b + c), which ends the interval where it
// touches 0.
TEST(PairedRates, EndIsZeroWhereMcNemarsScoreIsCritical) {
  const PairedCounts counts{.both = 20, .only_first = 3, .only_second = 13, .neither = 8};
  const double score = 10.0 / std::sqrt(16.0);
  EXPECT_NEAR(DifferenceInterval(counts, std::erf(score / std::sqrt(2.0))).low, 0.0, 1e-9);
}

// The same for two groups: the pooled z score.
TEST(UnpairedRates, EndIsZeroWhereThePooledScoreIsCritical) {
  const ContingencyTable table{20, 30, 36, 14};
  const double pooled = 56.0 / 100.0;
  const double score = (0.72 - 0.4) / std::sqrt(pooled * (1.0 - pooled) * 2.0 / 50.0);
  EXPECT_NEAR(DifferenceInterval(table, std::erf(score / std::sqrt(2.0))).low, 0.0, 1e-9);
}

// Of the tables of two groups of n that have the property, but for impossible ones.
template <typename Property>
double ChanceOf(std::int64_t n, const RatePair& rates, const Property& holds) {
  const CountLaw a = BinomialLaw(n, rates.first);
  const CountLaw b = BinomialLaw(n, rates.second);
  double chance = 0.0;
  for (std::int64_t i = 0; i <= n; ++i) {
    for (std::int64_t j = 0; j <= n; ++j) {
      const double weight = a[static_cast<std::size_t>(i)] * b[static_cast<std::size_t>(j)];
      if (weight > 1e-12 && holds(ContingencyTable{i, n - i, j, n - j})) chance += weight;
    }
  }
  return chance;
}

// Exact size of TOST at the margin: the chance to call two groups equivalent that differ by it.
double ExactSize(std::int64_t n, double first, double margin) {
  return ChanceOf(n, {first, first + margin}, [margin](const ContingencyTable& table) {
    return EquivalencePValue(table, margin) <= 0.05;
  });
}

TEST(UnpairedRates, EquivalenceKeepsItsLevel) {
  for (const double margin : {0.05, 0.1, 0.15, 0.3}) {
    for (const std::int64_t n : {10, 25, 50, 100}) {
      for (const double share : {0.0, 0.01, 0.1, 0.25, 0.5, 0.75, 1.0}) {
        EXPECT_LE(ExactSize(n, share * (1.0 - margin), margin), 0.05)
            << n << ' ' << margin << ' ' << share;
      }
    }
  }
  EXPECT_GT(ExactSize(100, 0.5, 0.3), 0.03) << "the test rejects at all";
}

// The same of pairs: discordant pairs of both kinds, their difference the margin. Sums over the
// counts that the test rejects (a trinomial law as two binomial ones).
double ExactPairedSize(std::int64_t n, double only_first, double margin) {
  const CountLaw first = BinomialLaw(n, only_first);
  double size = 0.0;
  for (std::int64_t b = 0; b <= n; ++b) {
    const double weight = first[static_cast<std::size_t>(b)];
    if (weight < 1e-10) continue;
    const CountLaw second = BinomialLaw(n - b, (only_first + margin) / (1.0 - only_first));
    for (std::int64_t c = 0; c <= n - b; ++c) {
      const double chance = weight * second[static_cast<std::size_t>(c)];
      if (chance < 1e-12) continue;
      const PairedCounts counts{.both = n - b - c, .only_first = b, .only_second = c};
      if (EquivalencePValue(counts, margin) <= 0.05) size += chance;
    }
  }
  return size;
}

TEST(PairedRates, EquivalenceKeepsItsLevel) {
  for (const double margin : {0.05, 0.1, 0.2, 0.3}) {
    for (const std::int64_t n : {10, 25, 42, 58, 100}) {
      for (const double share : {0.0, 0.01, 0.05, 0.2, 0.5, 0.9}) {
        EXPECT_LE(ExactPairedSize(n, share * 0.5 * (1.0 - margin), margin), 0.05)
            << n << ' ' << margin << ' ' << share;
      }
    }
  }
  EXPECT_GT(ExactPairedSize(100, 0.1, 0.2), 0.03) << "the test rejects at all";
}

// Which setting is called the second one changes the sign of the difference and nothing else: both
// margins are held with the same correction.
TEST(PairedRates, BothMarginsAreHeldAlike) {
  for (const double margin : {0.05, 0.1, 0.3}) {
    for (std::int64_t first = 0; first <= 12; ++first) {
      for (std::int64_t second = 0; second < first; ++second) {
        const std::int64_t rest = 42 - first - second;
        const PairedCounts down{.both = rest, .only_first = first, .only_second = second};
        const PairedCounts up{.both = rest, .only_first = second, .only_second = first};
        EXPECT_NEAR(EquivalencePValue(down, margin), EquivalencePValue(up, margin), 1e-12)
            << first << ' ' << second << ' ' << margin;
      }
    }
  }
}

TEST(UnpairedRates, BothMarginsAreHeldAlike) {
  for (const double margin : {0.05, 0.1, 0.3}) {
    for (std::int64_t i = 0; i <= 30; i += 3) {
      for (std::int64_t j = 0; j <= 40; j += 4) {
        const ContingencyTable table{i, 30 - i, j, 40 - j};
        const ContingencyTable swapped{j, 40 - j, i, 30 - i};
        EXPECT_NEAR(EquivalencePValue(table, margin), EquivalencePValue(swapped, margin), 1e-9)
            << i << ' ' << j << ' ' << margin;
      }
    }
  }
}

// With no discordant pair of n the variance at either margin m is n m (1 - m), and the score is
// (n m - 1/2) over its root: half a pair less than without the correction.
TEST(PairedRates, CorrectionIsHalfAPairInClosedForm) {
  for (const double margin : {0.05, 0.1, 0.2}) {
    const double n = 40.0;
    const double score = (n * margin - 0.5) / std::sqrt(n * margin * (1.0 - margin));
    const PairedCounts counts{.both = 25, .neither = 15};
    EXPECT_NEAR(EquivalencePValue(counts, margin), 0.5 * std::erfc(score / std::sqrt(2.0)), 1e-12);
  }
}

// Both groups without a failure have likeliest rates 1 and 1 - m: the score is m less the
// correction of half a trial of each group, (1 / n_1 + 1 / n_2) / 4, over sqrt(m (1 - m) / n).
TEST(UnpairedRates, CorrectionIsHalfATrialOfEachGroupInClosedForm) {
  const double n = 60.0;
  const double margin = 0.1;
  const double score = (margin - 0.25 * (2.0 / n)) / std::sqrt(margin * (1.0 - margin) / n);
  EXPECT_NEAR(EquivalencePValue(ContingencyTable{60, 0, 60, 0}, margin),
              0.5 * std::erfc(score / std::sqrt(2.0)), 1e-9);
}

// P(Binomial(n, margin / range) <= differing), by hand.
TEST(SparseEquivalence, IsABinomialTail) {
  EXPECT_NEAR(SparseEquivalencePValue(10, 0, 1.0, 4.0), std::pow(0.75, 10), 1e-12);
  EXPECT_NEAR(SparseEquivalencePValue(3, 1, 1.0, 2.0), 0.5, 1e-12);
  EXPECT_NEAR(SparseEquivalencePValue(59, 0, 1.0, 0.0), std::pow(0.95, 59), 1e-12);
  EXPECT_EQ(SparseEquivalencePValue(3, 1, 2.0, 2.0), 0.0) << "no pair can move the mean so far";
  EXPECT_EQ(SparseEquivalencePValue(3, 3, 1.0, 2.0), 1.0);
  EXPECT_EQ(SparseEquivalencePValue(0, 0, 1.0, 2.0), 1.0);
}

// Negative control: "not significant" calls the same groups equal far more often.
TEST(UnpairedRates, NotSignificantIsNotEquivalent) {
  const double called_equal =
      ChanceOf(120, {0.5, 0.65}, [](const auto& table) { return FisherExactPValue(table) > 0.05; });
  EXPECT_GT(called_equal, 0.25);
}

TEST(Median, RanksEqualTheBinomialLaws) {
  for (const core::JsonValue& c : At(ScipyNumbers(), "median_ranks").list()) {
    const auto n = static_cast<std::size_t>(c.list()[0].integer());
    std::vector<double> ranks(n);
    for (std::size_t i = 0; i < n; ++i) ranks[i] = static_cast<double>(i + 1);
    const Interval interval = MedianInterval(ranks);
    const double rank = c.list()[1].number();  // scipy's ppf: the first whose tail is above 2.5 %
    EXPECT_EQ(interval.low, rank) << n;
    EXPECT_EQ(interval.high, static_cast<double>(n) + 1.0 - rank) << n;
  }
  EXPECT_TRUE(std::isnan(MedianInterval(std::vector<double>{1, 2, 3, 4, 5}).low));
}

TEST(SampleSize, ClaimsEqualScipy) {
  for (const core::JsonValue& c : At(ScipyNumbers(), "claims").list()) {
    EXPECT_EQ(TrialsForClaim(c.list()[0].number(), c.list()[2].number(), c.list()[1].integer()),
              c.list()[3].integer());
  }
  EXPECT_EQ(TrialsForClaim(0.001, 0.95, 0), 2995);
  EXPECT_NEAR(ClaimChance(2995, 0.001, 0), 0.05, 1e-4);
}

TEST(SampleSize, OneTrialLessIsNotEnough) {
  const std::int64_t n = TrialsForHalfWidth(0.5, 0.02, 0.95, IntervalMethod::kWilson);
  const auto half = [](std::int64_t trials) {
    const Interval i = ProportionInterval((trials + 1) / 2, trials);
    return 0.5 * (i.high - i.low);
  };
  EXPECT_LE(half(n), 0.02);
  EXPECT_GT(half(n - 1), 0.02);
  EXPECT_NEAR(static_cast<double>(n), 2401.0, 5.0);
  EXPECT_EQ(TrialsForStopping(0.5, 0.02, 0.95, 100) % 100, 0);
}

TEST(SampleSize, PowersAreReached) {
  for (const RatePair rates :
       {RatePair{0.85, 0.75}, RatePair{0.001, 0.02}, RatePair{0.0, 0.05}, RatePair{0.9, 0.99}}) {
    const std::int64_t n = TrialsForFisher(rates, 0.05, 0.8);
    EXPECT_GE(FisherPower(n, rates, 0.05), 0.8) << rates.first;
    EXPECT_LT(FisherPower(n - 1, rates, 0.05), 0.8) << rates.first;
  }
  EXPECT_GT(FisherPower(TrialsForFisherFormula({0.0, 0.05}, 0.05, 0.8), {0.0, 0.05}, 0.05), 0.9)
      << "the formula asks for too many of what is rare";
  const RatePair discordant{0.15, 0.05};
  const std::int64_t pairs = TrialsForMcNemar(discordant, 0.05, 0.8);
  EXPECT_GE(McNemarPower(pairs, discordant, 0.05), 0.8);
  EXPECT_LT(McNemarPower(pairs - 1, discordant, 0.05), 0.8);
  // Large samples: (1.645 + 1.282)^2 / margin^2 pairs of unit deviation, 80 % on both sides.
  EXPECT_NEAR(static_cast<double>(TrialsForEquivalence(0.1, 1.0, 0.05, 0.8, Pairing::kPaired)),
              856.0, 3.0);
}

// The power is the chance to reject, summed by hand over a small design.
TEST(SampleSize, FisherPowerIsTheSumOverTables) {
  const RatePair rates{0.3, 0.8};
  const double power =
      ChanceOf(15, rates, [](const auto& table) { return FisherExactPValue(table) <= 0.05; });
  EXPECT_NEAR(FisherPower(15, rates, 0.05), power, 1e-9);
}

}  // namespace
}  // namespace rockyard::statistics
