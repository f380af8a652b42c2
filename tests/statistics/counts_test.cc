#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/random.h"
#include "statistics/clustered_rate.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {
namespace {

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

TEST(OneLayoutBounds, ContainTheIndependentValueAndTheDecidedOne) {
  const double independent = TwoSided(CountTails(PredictiveCountLaw(6, 285, 300), 4));
  const Interval bounds = OneLayoutPValueBounds(6, 4, 285, 300);
  EXPECT_LE(bounds.low, independent + 1e-3);
  EXPECT_GE(bounds.high, independent - 1e-3);
  // All runs successful: P(6 of 6) lies between p^6 (independent) and p (layouts decide all); both
  // tails of the p-value are then wide open above.
  EXPECT_GT(OneLayoutPValueBounds(6, 6, 150, 300).high, 0.9);
  const Interval low_rate = OneLayoutPValueBounds(6, 6, 30, 300);
  EXPECT_NEAR(low_rate.high, 2.0 * 30.5 / 301.0, 0.01);
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
