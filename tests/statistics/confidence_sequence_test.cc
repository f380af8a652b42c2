// The confidence sequence: what it promises, exactly and in simulation, and what peeking costs.
#include "statistics/confidence_sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/distributions.h"
#include "core/random.h"

namespace rockyard::statistics {
namespace {

struct Method {
  Interval (*interval)(std::int64_t successes, std::int64_t trials);
  bool (*holds)(std::int64_t successes, std::int64_t trials, double rate);
};

// By the martingale itself, so that the interval's ends are checked by something else.
constexpr Method kSequence = {
    [](std::int64_t s, std::int64_t n) { return ConfidenceSequence(s, n, 0.95); },
    [](std::int64_t s, std::int64_t n, double rate) {
      return LogMixtureMartingale(s, n, rate) < -std::log(0.05);
    }};
constexpr Method kWilson = {
    [](std::int64_t s, std::int64_t n) { return ProportionInterval(s, n, 0.95); },
    [](std::int64_t s, std::int64_t n, double rate) {
      const Interval i = ProportionInterval(s, n, 0.95);
      return i.low <= rate && rate <= i.high;
    }};

// For each look n = block, 2 block, ... the successes whose interval holds the rate: one range,
// since both ends grow with the successes.
struct Held {
  std::int64_t first = 0;
  std::int64_t last = -1;
};

Held HeldCounts(const Method& method, std::int64_t n, double rate) {
  const auto near = static_cast<std::int64_t>(rate * static_cast<double>(n));
  Held held{near, near};
  while (held.first > 0 && method.holds(held.first - 1, n, rate)) --held.first;
  while (held.last < n && method.holds(held.last + 1, n, rate)) ++held.last;
  return held;
}

// Probability that the interval misses the rate at any look up to n, exactly: the law of the
// successes over paths that were never missed.
double MissedByThen(const Method& method, double rate, std::int64_t last, std::int64_t block) {
  std::vector<double> law(static_cast<std::size_t>(last) + 1, 0.0);
  law[0] = 1.0;
  double missed = 0.0;
  for (std::int64_t n = 1; n <= last; ++n) {
    for (std::int64_t s = n; s > 0; --s) {
      law[s] = law[s] * (1.0 - rate) + law[s - 1] * rate;
    }
    law[0] *= 1.0 - rate;
    if (n % block != 0) continue;
    const Held held = HeldCounts(method, n, rate);
    for (std::int64_t s = 0; s <= n; ++s) {
      if (s >= held.first && s <= held.last) continue;
      missed += law[s];
      law[s] = 0.0;
    }
  }
  return missed;
}

// Looks at every trial to 300, exactly: the promise is for any number of looks and every rate.
TEST(ConfidenceSequence, MissesSeldomerThanAlphaHoweverOftenOneLooks) {
  for (const double rate : {0.001, 0.01, 0.05, 0.1, 0.3, 0.5, 0.77, 0.9, 0.99}) {
    EXPECT_LE(MissedByThen(kSequence, rate, 300, 1), 0.05) << rate;
  }
}

// Looks at every 25th of 2000, as a campaign does.
TEST(ConfidenceSequence, MissesSeldomerThanAlphaAtBlockEnds) {
  for (const double rate : {0.002, 0.02, 0.2, 0.5, 0.85, 0.95, 0.998}) {
    EXPECT_LE(MissedByThen(kSequence, rate, 2000, 25), 0.05) << rate;
  }
}

// Negative control: an interval for one look, looked at eighty times.
TEST(ConfidenceSequence, PeekingAtWilsonsIntervalMissesFarTooOften) {
  for (const double rate : {0.2, 0.5, 0.85}) {
    EXPECT_GT(MissedByThen(kWilson, rate, 2000, 25), 0.2) << rate;
  }
}

// One simulated campaign.
struct Stopped {
  std::int64_t trials = 0;
  bool missed_ever = false;     // at a look up to the stop
  bool missed_at_stop = false;  // by the interval that is reported
};

Stopped Campaign(const Method& method, double rate, double half_width, std::int64_t most,
                 std::int64_t block, std::uint32_t campaign) {
  core::RandomStream stream({.seed = 71, .trial = campaign}, core::Purpose::kTest);
  Stopped result;
  std::int64_t successes = 0;
  for (std::int64_t n = 1; n <= most; ++n) {
    successes += core::SampleBernoulli(stream, rate) ? 1 : 0;
    if (n % block != 0) continue;
    result.trials = n;
    result.missed_at_stop = !method.holds(successes, n, rate);
    result.missed_ever = result.missed_ever || result.missed_at_stop;
    if (half_width <= 0.0) continue;
    const Interval i = method.interval(successes, n);
    if (0.5 * (i.high - i.low) <= half_width) break;
  }
  return result;
}

// Simulated share equals the exact one within 4 standard errors (alpha 6e-5 for each rate).
TEST(ConfidenceSequence, SimulatedCoverageIsTheExactOne) {
  constexpr std::uint32_t kCampaigns = 4000;
  for (const double rate : {0.05, 0.5, 0.9}) {
    int missed = 0;
    for (std::uint32_t c = 0; c < kCampaigns; ++c) {
      missed += Campaign(kSequence, rate, 0.0, 400, 10, c).missed_ever ? 1 : 0;
    }
    const double exact = MissedByThen(kSequence, rate, 400, 10);
    const double error = std::sqrt(exact * (1.0 - exact) / kCampaigns);
    EXPECT_NEAR(static_cast<double>(missed) / kCampaigns, exact, 4.0 * error) << rate;
  }
}

// Stopped where the half-width is 0.05, at the first block end. (Wilson's interval would survive
// this rule, which hardly looks at the rate, but not the next one: see above.)
TEST(ConfidenceSequence, IntervalAtTheStopCovers) {
  constexpr std::uint32_t kCampaigns = 1000;
  for (const double rate : {0.5, 0.85, 0.97}) {
    int missed = 0;
    for (std::uint32_t c = 0; c < kCampaigns; ++c) {
      missed += Campaign(kSequence, rate, 0.05, 5000, 25, c).missed_at_stop ? 1 : 0;
    }
    EXPECT_LE(missed, 0.05 * kCampaigns) << rate;
  }
}

// The price of honest looks: two to four times the trials of a design with one look.
TEST(ConfidenceSequence, CostsTwoToFourTimesTheTrialsOfOneLook) {
  for (const double rate : {0.5, 0.85, 0.95}) {
    double trials = 0.0;
    constexpr std::uint32_t kCampaigns = 50;
    for (std::uint32_t c = 0; c < kCampaigns; ++c) {
      trials +=
          static_cast<double>(Campaign(kSequence, rate, 0.05, 20000, 25, c).trials) / kCampaigns;
    }
    const double one_look = 1.959964 * 1.959964 * rate * (1.0 - rate) / (0.05 * 0.05);
    EXPECT_GT(trials, 2.0 * one_look) << rate;
    EXPECT_LT(trials, 4.5 * one_look) << rate;
  }
}

TEST(ConfidenceSequence, KnownValues) {
  // One trial: M = (1/2) / p, so that the end is where it is 20.
  EXPECT_NEAR(ConfidenceSequence(1, 1).low, 0.025, 1e-15);
  EXPECT_EQ(ConfidenceSequence(1, 1).high, 1.0);
  EXPECT_NEAR(ConfidenceSequence(0, 1).high, 0.975, 1e-15);
  // Two trials, one success: M = (1/8) / (p (1 - p)) = 20.
  EXPECT_NEAR(ConfidenceSequence(1, 2).low, 0.5 - std::sqrt(0.25 - 1.0 / 160.0), 1e-12);
  EXPECT_NEAR(ConfidenceSequence(1, 2).high, 0.5 + std::sqrt(0.25 - 1.0 / 160.0), 1e-12);
  EXPECT_EQ(ConfidenceSequence(0, 0).low, 0.0);
  EXPECT_EQ(ConfidenceSequence(0, 0).high, 1.0);
}

TEST(ConfidenceSequence, EndsAreWhereTheMartingaleReachesTheLimit) {
  for (const std::int64_t n : {7, 100, 5000, 1000000}) {
    for (const std::int64_t s : {std::int64_t{1}, n / 3, n / 2, n - 1}) {
      const Interval i = ConfidenceSequence(s, n, 0.99);
      EXPECT_NEAR(LogMixtureMartingale(s, n, i.low), std::log(100.0), 1e-6) << s << "/" << n;
      // 1 - 3e-12 is a double to 1e-16: a relative 4e-5 of what is left.
      EXPECT_NEAR(LogMixtureMartingale(s, n, i.high), std::log(100.0), 1e-4) << s << "/" << n;
      EXPECT_LT(LogMixtureMartingale(s, n, static_cast<double>(s) / static_cast<double>(n)), 0.0);
      const Interval mirrored = ConfidenceSequence(n - s, n, 0.99);
      EXPECT_NEAR(i.low, 1.0 - mirrored.high, 1e-15);
    }
  }
}

// The mean of M over all outcomes is 1 where the rate is true: a martingale, hand-summed.
TEST(ConfidenceSequence, MartingaleHasMeanOne) {
  for (const double rate : {0.03, 0.4, 0.9}) {
    constexpr std::int64_t kTrials = 12;
    double mean = 0.0;
    double probability = std::pow(1.0 - rate, kTrials);
    for (std::int64_t s = 0; s <= kTrials; ++s) {
      mean += probability * std::exp(LogMixtureMartingale(s, kTrials, rate));
      probability *=
          static_cast<double>(kTrials - s) / static_cast<double>(s + 1) * rate / (1.0 - rate);
    }
    EXPECT_NEAR(mean, 1.0, 1e-12) << rate;
  }
}

}  // namespace
}  // namespace rockyard::statistics
