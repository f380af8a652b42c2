// Whether intervals of Shapley shares and interactions hold the truth as often as they say.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "core/random.h"
#include "statistics/attribution.h"

namespace rockyard::statistics {
namespace {

constexpr std::size_t kTrials = 150;
constexpr int kCampaigns = 2000;

// A trial fails where u < 0.25 unless a is perfect, or where w < 0.10 unless both are perfect; u
// and w are independent and the same in all four combinations.
void AddTrial(double u, double w, FactorialFailures& failures) {
  for (Combination c = 0; c < 4; ++c) {
    const bool fails = (u < 0.25 && (c & 1U) == 0) || (w < 0.10 && c != 3U);
    failures.failed[c].push_back(fails ? 1 : 0);
  }
}

FactorialFailures NoTrials() { return {{"a", "b"}, std::vector<std::vector<std::uint8_t>>(4)}; }

FactorialFailures Draw(std::uint32_t campaign) {
  FactorialFailures failures = NoTrials();
  core::RandomStream stream({11, campaign}, core::Purpose::kTest);
  for (std::size_t t = 0; t < kTrials; ++t) {
    const double u = stream.Uniform();
    AddTrial(u, stream.Uniform(), failures);
  }
  return failures;
}

// P(fail) by inclusion and exclusion.
constexpr std::array<double, 4> kTruth{0.25 + 0.10 - 0.025, 0.10, 0.25 + 0.10 - 0.025, 0.0};

// The same, but 3 of 5 trials of a layout, on average, draw what the layout draws: 50 layouts of 3.
constexpr std::size_t kPerLayout = 3;
FactorialFailures DrawOnLayouts(std::uint32_t campaign) {
  FactorialFailures failures = NoTrials();
  core::RandomStream stream({12, campaign}, core::Purpose::kTest);
  std::array<double, 2> layout{};
  for (std::size_t t = 0; t < kTrials; ++t) {
    if (t % kPerLayout == 0) layout = {stream.Uniform(), stream.Uniform()};
    const std::array<double, 2> own{stream.Uniform(), stream.Uniform()};
    const std::array<double, 2>& drawn = stream.Uniform() < 0.8 ? layout : own;
    AddTrial(drawn[0], drawn[1], failures);
    failures.clusters.push_back(t / kPerLayout);
  }
  return failures;
}

FactorialFailures DrawAsIfIndependent(std::uint32_t campaign) {
  FactorialFailures failures = DrawOnLayouts(campaign);
  failures.clusters.clear();
  return failures;
}

using Drawing = FactorialFailures (*)(std::uint32_t);

double Coverage(const Contrast& contrast, double confidence, Drawing draw = Draw) {
  double truth = 0.0;
  for (std::size_t c = 0; c < 4; ++c) truth += contrast.weights[c] * kTruth[c];
  int held = 0;
  for (std::uint32_t campaign = 0; campaign < kCampaigns; ++campaign) {
    const Interval interval = Estimated(draw(campaign), contrast, confidence).interval;
    if (interval.low <= truth && truth <= interval.high) ++held;
  }
  return static_cast<double>(held) / kCampaigns;
}

// Simulated coverage lies within four standard errors (0.0049 each) of what a near-nominal method
// may have: 0.935 to 0.97. A sound method leaves that once in some 10^4 sets of seeds.
bool IsNearNominal(double coverage) {
  const double slack = 4.0 * std::sqrt(0.95 * 0.05 / kCampaigns);
  return coverage > 0.935 - slack && coverage < 0.97 + slack;
}

TEST(AttributionCoverageTest, SharesAndInteractionsAreCoveredAsStated) {
  for (const Contrast& contrast :
       {ShapleyShare(2, 0), ShapleyShare(2, 1), FactorialEffect(2, 3), Removed(2, 3)}) {
    const double coverage = Coverage(contrast, 0.95);
    EXPECT_TRUE(IsNearNominal(coverage)) << coverage;
  }
}

// The negative control is what takes trials on one layout for independent.
TEST(AttributionCoverageTest, SharesAreCoveredWhereTrialsShareLayouts) {
  for (const Contrast& contrast : {ShapleyShare(2, 0), ShapleyShare(2, 1), Removed(2, 3)}) {
    const double coverage = Coverage(contrast, 0.95, DrawOnLayouts);
    EXPECT_TRUE(IsNearNominal(coverage)) << coverage;
    const double independent = Coverage(contrast, 0.95, DrawAsIfIndependent);
    EXPECT_LT(independent, 0.9);
  }
}

TEST(AttributionCoverageTest, LayoutsThatAgreeSayAsMuchAsOneTrialEach) {
  FactorialFailures failures{{"a"}, {std::vector<std::uint8_t>(40), std::vector<std::uint8_t>(40)}};
  const double independent = Attribute(failures).failures[0].interval.high;
  for (std::size_t t = 0; t < 40; ++t) failures.clusters.push_back(t / 4);
  const Attribution result = Attribute(failures);
  EXPECT_GT(result.failures[0].interval.high, 0.3) << "no failure on ten layouts";
  EXPECT_LT(independent, 0.1);
  EXPECT_GT(result.removed.interval.high, 0.15);
}

// Negative control: intervals of 80 % do not pass for such of 95 %.
TEST(AttributionCoverageTest, NarrowerIntervalsAreFoundOut) {
  EXPECT_FALSE(IsNearNominal(Coverage(ShapleyShare(2, 0), 0.80)));
}

}  // namespace
}  // namespace rockyard::statistics
