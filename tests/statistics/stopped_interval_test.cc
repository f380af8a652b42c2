// The interval of a rate whose half-width ends the trials: its coverage over all paths, exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "statistics/proportions.h"
#include "statistics/sample_size.h"

namespace rockyard::statistics {
namespace {

// Trials are looked at every `block` of them, `most` at most, and end where the half-width is
// reached.
struct Rule {
  double half_width = 0.05;
  std::int64_t block = 1;
  std::int64_t most = 100'000;
};

// What the interval of each number of successes at one look says.
struct Look {
  std::int64_t trials = 0;
  std::vector<Interval> intervals;  // by successes
};

// Every look until all paths have ended. The same for each rate.
std::vector<Look> Looks(const Rule& rule, IntervalMethod method) {
  std::vector<Look> looks;
  for (std::int64_t n = rule.block;; n += rule.block) {
    Look& look = looks.emplace_back(Look{std::min(n, rule.most), {}});
    bool all_narrow = true;
    for (std::int64_t s = 0; s <= look.trials; ++s) {
      const Interval each = ProportionInterval(s, look.trials, 0.95, method);
      look.intervals.push_back(each);
      all_narrow = all_narrow && each.high - each.low <= 2.0 * rule.half_width;
    }
    if (all_narrow || look.trials == rule.most) return looks;
  }
}

struct Stop {
  double coverage = 0.0;
  double mean_trials = 0.0;
};

// The law of the successes over paths that have not ended, trial by trial.
Stop AtTheStop(const Rule& rule, const std::vector<Look>& looks, double rate) {
  std::vector<double> law(static_cast<std::size_t>(looks.back().trials) + 1, 0.0);
  law[0] = 1.0;
  Stop stop;
  std::int64_t n = 0;
  for (const Look& look : looks) {
    while (n < look.trials) {
      ++n;
      for (std::int64_t s = n; s > 0; --s) law[s] = law[s] * (1.0 - rate) + law[s - 1] * rate;
      law[0] *= 1.0 - rate;
    }
    for (std::int64_t s = 0; s <= n; ++s) {
      const Interval& each = look.intervals[static_cast<std::size_t>(s)];
      const bool ends = each.high - each.low <= 2.0 * rule.half_width || n == rule.most;
      if (!ends) continue;
      stop.mean_trials += law[s] * static_cast<double>(n);
      if (each.low <= rate && rate <= each.high) stop.coverage += law[s];
      law[s] = 0.0;
    }
  }
  return stop;
}

double LeastCoverage(const Rule& rule, IntervalMethod method) {
  const std::vector<Look> looks = Looks(rule, method);
  double least = 1.0;
  for (int i = 4; i <= 396; ++i) {
    least = std::min(least, AtTheStop(rule, looks, i / 400.0).coverage);
  }
  return least;
}

class StoppedIntervalTest : public testing::TestWithParam<Rule> {};

TEST_P(StoppedIntervalTest, CoversAsOftenAsDeclared) {
  EXPECT_GE(LeastCoverage(GetParam(), IntervalMethod::kStopped), 0.945);
}

INSTANTIATE_TEST_SUITE_P(Rules, StoppedIntervalTest,
                         testing::Values(Rule{0.15, 1}, Rule{0.15, 25}, Rule{0.1, 1}, Rule{0.1, 10},
                                         Rule{0.1, 25}, Rule{0.1, 100}, Rule{0.05, 1},
                                         Rule{0.05, 10}, Rule{0.05, 25}, Rule{0.05, 100},
                                         Rule{0.03, 25}, Rule{0.05, 25, 200}));

// Negative controls: intervals that take the number of trials as fixed.
TEST(StoppedInterval, OthersCoverTooSeldom) {
  EXPECT_LT(LeastCoverage({0.1, 1}, IntervalMethod::kClopperPearson), 0.942);
  EXPECT_LT(LeastCoverage({0.05, 10}, IntervalMethod::kClopperPearson), 0.942);
  EXPECT_LT(LeastCoverage({0.05, 10}, IntervalMethod::kWilson), 0.935);
}

// A rule that ends at its first look has one look: coverage is Clopper and Pearson's at least.
TEST(StoppedInterval, OneLookIsTheExactInterval) {
  EXPECT_GE(LeastCoverage({0.4, 100}, IntervalMethod::kStopped), 0.96);
}

// A tenth more trials than Wilson's interval needs where their number is fixed, and what the block
// adds.
TEST(StoppedInterval, CostsLittleMoreThanAFixedNumber) {
  const Rule rule{0.05, 10};
  const double mean = AtTheStop(rule, Looks(rule, IntervalMethod::kStopped), 0.73).mean_trials;
  const std::int64_t fixed = TrialsForHalfWidth(0.73, 0.05, 0.95, IntervalMethod::kWilson);
  EXPECT_LT(mean, 1.2 * static_cast<double>(fixed));
  EXPECT_NEAR(static_cast<double>(TrialsForStopping(0.73, 0.05, 0.95, 10)), mean, 10.0);
}

TEST(StoppedInterval, IsClopperAndPearsonsAtFourFifthsOfTheChance) {
  const Interval stopped = ProportionInterval(7, 40, 0.95, IntervalMethod::kStopped);
  const Interval exact = ProportionInterval(7, 40, 0.96, IntervalMethod::kClopperPearson);
  EXPECT_DOUBLE_EQ(stopped.low, exact.low);
  EXPECT_DOUBLE_EQ(stopped.high, exact.high);
  EXPECT_EQ(MethodName(IntervalMethod::kStopped), "clopper_pearson_stopped");
}

}  // namespace
}  // namespace rockyard::statistics
