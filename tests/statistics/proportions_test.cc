#include "statistics/proportions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/random.h"
#include "oracles.h"
#include "statistics/clustered_rate.h"

namespace rockyard::statistics {
namespace {

TEST(ProportionInterval, ClopperPearsonEqualsOracles) {
  for (const core::JsonValue& c : At(Oracles(), "clopper_pearson").list()) {
    const Interval interval =
        ProportionInterval(At(c, "k").integer(), At(c, "n").integer(),
                           1.0 - At(c, "alpha").number(), IntervalMethod::kClopperPearson);
    const auto expected = Numbers(At(c, "ci"));
    EXPECT_NEAR(interval.low, expected[0], 1e-10);
    EXPECT_NEAR(interval.high, expected[1], 1e-10);
  }
}

TEST(ProportionInterval, WilsonEqualsOracles) {
  for (const core::JsonValue& c : At(Oracles(), "wilson_95").list()) {
    const Interval interval = ProportionInterval(At(c, "k").integer(), At(c, "n").integer());
    const auto expected = Numbers(At(c, "ci"));
    EXPECT_NEAR(interval.low, expected[0], 1e-12);
    EXPECT_NEAR(interval.high, expected[1], 1e-12);
  }
}

TEST(ProportionInterval, UpperEndWithoutSuccessIsTheExactRuleOfThree) {
  for (const std::int64_t n : {1, 10, 100, 10000}) {
    const Interval interval = ProportionInterval(0, n, 0.90, IntervalMethod::kClopperPearson);
    EXPECT_NEAR(interval.high, 1.0 - std::pow(0.05, 1.0 / static_cast<double>(n)), 1e-12);
    EXPECT_EQ(interval.low, 0.0);
  }
}

TEST(ProportionInterval, NoTrialsLeaveEverythingOpen) {
  const Proportion none = MakeProportion(0, 0);
  EXPECT_TRUE(std::isnan(none.rate));
  EXPECT_EQ(none.interval.low, 0.0);
  EXPECT_EQ(none.interval.high, 1.0);
}

// Probability that the interval covers the true rate, by summing over all counts.
double Coverage(std::int64_t n, double rate, IntervalMethod method) {
  const CountLaw law = BinomialLaw(n, rate);
  double coverage = 0.0;
  for (std::int64_t k = 0; k <= n; ++k) {
    const Interval interval = ProportionInterval(k, n, 0.95, method);
    if (interval.low <= rate && rate <= interval.high) coverage += law[static_cast<std::size_t>(k)];
  }
  return coverage;
}

TEST(ExactInterval, TakesCountsThatAreNotWhole) {
  // None of n: 1 - 0.025^(1/n), whatever n is.
  EXPECT_NEAR(ExactInterval(0.0, 7.5).high, 1.0 - std::pow(0.025, 1.0 / 7.5), 1e-12);
  EXPECT_NEAR(ExactInterval(7.5, 7.5).low, std::pow(0.025, 1.0 / 7.5), 1e-12);
  const Interval whole = ProportionInterval(19, 199, 0.95, IntervalMethod::kClopperPearson);
  EXPECT_EQ(ExactInterval(19.0, 199.0).low, whole.low);
  EXPECT_EQ(ExactInterval(19.0, 199.0).high, whole.high);
  EXPECT_GT(ExactInterval(19.5, 199.0).low, whole.low);
  EXPECT_LT(ExactInterval(18.5, 199.0).high, whole.high);
}

TEST(ProportionInterval, ExactCoverage) {
  double sum = 0.0;
  double lowest = 1.0;
  int rates = 0;
  for (double rate = 0.01; rate < 0.995; rate += 0.01) {
    EXPECT_GE(Coverage(40, rate, IntervalMethod::kClopperPearson), 0.95);
    const double wilson = Coverage(40, rate, IntervalMethod::kWilson);
    sum += wilson;
    lowest = std::min(lowest, wilson);
    ++rates;
  }
  EXPECT_NEAR(sum / rates, 0.95, 0.01);
  EXPECT_GT(lowest, 0.83);
  // Wilson is no exact interval: somewhere it covers less than it says.
  EXPECT_LT(lowest, 0.95);
}

// By exact sums, at rates beside the ends of the intervals, where coverage is least.
TEST(RateMethod, MendsWilsonsIntervalOfRareEvents) {
  EXPECT_EQ(RateMethod(4, 40, IntervalMethod::kWilson), IntervalMethod::kClopperPearson);
  EXPECT_EQ(RateMethod(5, 40, IntervalMethod::kWilson), IntervalMethod::kWilson);
  EXPECT_EQ(RateMethod(36, 40, IntervalMethod::kWilson), IntervalMethod::kClopperPearson);
  EXPECT_EQ(RateMethod(35, 40, IntervalMethod::kClopperPearson), IntervalMethod::kClopperPearson);
  for (const std::int64_t n : {20, 40, 100, 300}) {
    double lowest = 1.0;
    double wilson = 1.0;
    for (std::int64_t k = 1; k <= n / 2; ++k) {
      const double rate = MakeProportion(k, n).interval.low - 1e-9;
      const CountLaw law = BinomialLaw(n, rate);
      double covered = 0.0;
      for (std::int64_t j = 0; j <= n; ++j) {
        const Interval interval = MakeProportion(j, n).interval;
        if (interval.low <= rate && rate <= interval.high) {
          covered += law[static_cast<std::size_t>(j)];
        }
      }
      lowest = std::min(lowest, covered);
      const double beside = ProportionInterval(k, n).low - 1e-9;
      wilson = std::min(wilson, Coverage(n, beside, IntervalMethod::kWilson));
    }
    EXPECT_GT(lowest, 0.92) << n;
    EXPECT_LT(wilson, 0.85) << n;
  }
}

// Newcombe 1998 (Statistics in Medicine 17, pp. 873-890), table II, method 10, contrasts (a) to
// (h).
TEST(DifferenceInterval, EqualsNewcombesExamples) {
  struct Example {
    std::int64_t a, m, b, n;
    double low, high;
  };
  for (const Example& e : {Example{56, 70, 48, 80, 0.0524, 0.3339},
                           {9, 10, 3, 10, 0.1705, 0.8090},
                           {6, 7, 2, 7, 0.0582, 0.8062},
                           {5, 56, 0, 29, -0.0381, 0.1926},
                           {0, 10, 0, 20, -0.1611, 0.2775},
                           {0, 10, 0, 10, -0.2775, 0.2775},
                           {10, 10, 0, 20, 0.6791, 1.0},
                           {10, 10, 0, 10, 0.6075, 1.0}}) {
    const Interval interval =
        DifferenceInterval(MakeProportion(e.b, e.n), MakeProportion(e.a, e.m));
    EXPECT_NEAR(interval.low, e.low, 5e-5) << e.a << "/" << e.m;
    EXPECT_NEAR(interval.high, e.high, 5e-5) << e.a << "/" << e.m;
  }
}

TEST(DifferenceInterval, SwappedRunsSwapTheEndsAndNoTrialsLeaveEverythingOpen) {
  const Proportion a = MakeProportion(3, 20);
  const Proportion b = MakeProportion(11, 31);
  const Interval forward = DifferenceInterval(a, b, 0.99);
  const Interval backward = DifferenceInterval(b, a, 0.99);
  EXPECT_DOUBLE_EQ(forward.low, -backward.high);
  EXPECT_DOUBLE_EQ(forward.high, -backward.low);
  EXPECT_LT(forward.low, DifferenceInterval(a, b, 0.95).low);
  EXPECT_EQ(DifferenceInterval(a, MakeProportion(0, 0)).low, -1.0);
  EXPECT_EQ(DifferenceInterval(MakeProportion(0, 0), b).high, 1.0);
}

TEST(FisherExact, EqualsOracles) {
  for (const core::JsonValue& c : At(Oracles(), "fisher_exact").list()) {
    const auto first = Numbers(At(c, "table").list()[0]);
    const auto second = Numbers(At(c, "table").list()[1]);
    if (At(c, "alternative").text() != "two-sided") continue;
    const ContingencyTable table{std::llround(first[0]), std::llround(first[1]),
                                 std::llround(second[0]), std::llround(second[1])};
    EXPECT_NEAR(FisherExactPValue(table), At(c, "p").number(), 1e-10);
  }
}

TEST(FisherExact, LargeTablesInClosedForm) {
  // All n of the first group succeed and none of the second: 2 / C(2n, n).
  EXPECT_NEAR(FisherExactPValue({10, 0, 0, 10}) * 184756.0 / 2.0, 1.0, 1e-12);
  // One success in 2n, in the first group or in the second: both tables are equally likely.
  EXPECT_DOUBLE_EQ(FisherExactPValue({1, 999999, 0, 1000000}), 1.0);
  // Two successes, both in the first group: twice (n - 1) / (2 (2n - 1)).
  constexpr double kN = 1e6;
  EXPECT_NEAR(FisherExactPValue({2, 999998, 0, 1000000}), (kN - 1.0) / (2.0 * kN - 1.0), 1e-12);
  // What underflows is impossible, not undefined.
  EXPECT_EQ(FisherExactPValue({100000, 0, 0, 100000}), 0.0);
}

TEST(FisherExact, EmptyTableSaysNothing) { EXPECT_EQ(FisherExactPValue({}), 1.0); }

TEST(McNemarExact, ClosedForm) {
  EXPECT_EQ(McNemarExactPValue(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(McNemarExactPValue(5, 0), 2.0 / 32.0);
  EXPECT_DOUBLE_EQ(McNemarExactPValue(0, 5), 2.0 / 32.0);
  EXPECT_DOUBLE_EQ(McNemarExactPValue(1, 9), 2.0 * 11.0 / 1024.0);
  EXPECT_EQ(McNemarExactPValue(5, 5), 1.0);
}

double Sum(const CountLaw& law) { return std::accumulate(law.begin(), law.end(), 0.0); }

TEST(CountLaws, SumToOneAndMatchClosedForms) {
  EXPECT_NEAR(Sum(BinomialLaw(40, 0.97)), 1.0, 1e-12);
  EXPECT_NEAR(Sum(BetaBinomialLaw(40, 291.5, 9.5)), 1.0, 1e-12);
  const CountLaw uniform = BetaBinomialLaw(6, 1.0, 1.0);
  for (const double p : uniform) EXPECT_NEAR(p, 1.0 / 7.0, 1e-12);
  EXPECT_NEAR(BinomialLaw(6, 0.9)[4], 15.0 * std::pow(0.9, 4) * 0.01, 1e-14);
}

TEST(CountLaws, PredictionTendsToBinomialAsThePoolGrows) {
  const CountLaw exact = BinomialLaw(40, 0.9);
  const CountLaw predictive = PredictiveCountLaw(40, 9'000'000, 10'000'000);
  for (std::size_t k = 0; k < exact.size(); ++k) EXPECT_NEAR(predictive[k], exact[k], 1e-5);
}

TEST(CountLaws, SmallPoolWidensThePrediction) {
  const CountLaw large = PredictiveCountLaw(40, 900, 1000);
  const CountLaw small = PredictiveCountLaw(40, 27, 30);
  EXPECT_LT(CountQuantile(small, 0.025), CountQuantile(large, 0.025));
  EXPECT_GE(CountQuantile(small, 0.975), CountQuantile(large, 0.975));
}

TEST(CountTails, TwoSidedIsTwiceTheSmallerTail) {
  const CountLaw law = BinomialLaw(6, 0.5);
  EXPECT_DOUBLE_EQ(TwoSided(CountTails(law, 0)), 2.0 / 64.0);
  EXPECT_DOUBLE_EQ(TwoSided(CountTails(law, 6)), 2.0 / 64.0);
  EXPECT_DOUBLE_EQ(TwoSided(CountTails(law, 3)), 1.0);
}

TEST(CountPower, SixRunsCannotTellTwentyPercentButFortyCan) {
  const double level = 0.05;
  const auto power = [&](std::int64_t n) {
    return CountPower(PredictiveCountLaw(n, 291, 300), BinomialLaw(n, 0.77), level);
  };
  EXPECT_LT(power(6), 0.8);
  EXPECT_LT(power(12), 0.8);
  EXPECT_GT(power(40), 0.8);
  // Under the null itself power is the size of the test.
  EXPECT_LE(CountPower(BinomialLaw(40, 0.9), BinomialLaw(40, 0.9), level), level);
}

TEST(LayoutEffect, FindsNoneAndAll) {
  const std::vector<LayoutCount> decided = {{10, 10}, {0, 10}, {10, 10}, {10, 10}};
  EXPECT_NEAR(EstimateLayoutEffect(decided).correlation, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(EstimateLayoutEffect(decided).rate, 0.75);
  const std::vector<LayoutCount> same = {{8, 10}, {8, 10}, {8, 10}};
  EXPECT_EQ(EstimateLayoutEffect(same).correlation, 0.0);
  const std::vector<LayoutCount> once = {{1, 1}, {0, 1}, {1, 1}};
  EXPECT_TRUE(std::isnan(EstimateLayoutEffect(once).correlation));
  EXPECT_TRUE(std::isnan(EstimateLayoutEffect({}).correlation));
}

TEST(LayoutEffect, RecoversASimulatedCorrelation) {
  // Half of the layouts succeed with 0.9, half with 0.5: variance of the rate 0.04, mean 0.7,
  // correlation 0.04 / (0.7 * 0.3) = 0.190.
  core::RandomStream stream({.seed = 7, .trial = 0}, core::Purpose::kTest);
  std::vector<LayoutCount> layouts(400);
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    layouts[i].trials = 20;
    for (int t = 0; t < 20; ++t) {
      layouts[i].successes += core::SampleBernoulli(stream, i % 2 == 0 ? 0.9 : 0.5) ? 1 : 0;
    }
  }
  const LayoutEffect effect = EstimateLayoutEffect(layouts);
  EXPECT_NEAR(effect.rate, 0.7, 0.02);
  EXPECT_NEAR(effect.correlation, 0.190, 0.03);
  const CountLaw law = OneLayoutLaw(6, layouts, 1);
  EXPECT_NEAR(Sum(law), 1.0, 1e-9);
  // Counts on one layout scatter more than independent ones.
  EXPECT_GT(law[6], BinomialLaw(6, 0.7)[6]);
}

// Resamples that hold layouts of one trial alone have no correlation of their own: of 2 and 1
// trials a fourth of them, of one 2 and many 1 more than a third.
TEST(OneLayoutLawTest, IsALawWhereFewLayoutsHaveTwoTrials) {
  for (const std::size_t single : {1U, 9U}) {
    std::vector<LayoutCount> layouts(single + 1, {.successes = 1, .trials = 1});
    layouts.back() = {.successes = 1, .trials = 2};
    EXPECT_NEAR(Sum(OneLayoutLaw(6, layouts, 1)), 1.0, 1e-9);
  }
}

TEST(OneLayoutBounds, ContainTheIndependentValueAndTheDecidedOne) {
  const double independent = TwoSided(CountTails(PredictiveCountLaw(6, 285, 300), 4));
  const Interval bounds = OneLayoutPValueBounds(6, 4, 285, 300);
  EXPECT_LE(bounds.low, independent + 1e-3);
  EXPECT_GE(bounds.high, independent - 1e-3);
  // All runs successful: P(6 of 6) lies between p^6 (independent) and p (layouts decide all); both
  // tails of the p-value are then wide open above.
  EXPECT_GT(OneLayoutPValueBounds(6, 6, 150, 300).high, 0.9);
  EXPECT_NEAR(OneLayoutPValueBounds(6, 6, 30, 300).high, 2.0 * 30.5 / 301.0, 0.01);
}

// Garwood 1936, table 1, and the closed forms for none: no lower end, upper end -ln(tail).
TEST(PoissonIntervalTest, IsThePublishedTable) {
  EXPECT_EQ(PoissonInterval(0).low, 0.0);
  EXPECT_NEAR(PoissonInterval(0).high, -std::log(0.025), 1e-12);
  EXPECT_NEAR(PoissonInterval(1).low, -std::log(0.975), 1e-12);
  EXPECT_NEAR(PoissonInterval(10).low, 4.80, 0.005);
  EXPECT_NEAR(PoissonInterval(10).high, 18.39, 0.005);
  EXPECT_NEAR(PoissonInterval(10, 0.99).high, 21.40, 0.005);
}

// Its definition, by the sum of Poisson's probabilities.
TEST(PoissonIntervalTest, EndsLeaveTheTailsOnEitherSide) {
  for (const int count : {1, 3, 17}) {
    const Interval interval = PoissonInterval(count, 0.9);
    const auto at_most = [](int n, double mean) {
      double term = std::exp(-mean);
      double sum = term;
      for (int i = 1; i <= n; ++i) sum += term *= mean / i;
      return sum;
    };
    EXPECT_NEAR(1.0 - at_most(count - 1, interval.low), 0.05, 1e-10);
    EXPECT_NEAR(at_most(count, interval.high), 0.05, 1e-10);
  }
}

}  // namespace
}  // namespace rockyard::statistics
