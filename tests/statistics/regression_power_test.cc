// What a regression check says it would have seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "regression_data.h"
#include "statistics/sample_size.h"

namespace rockyard::statistics {
namespace {

// A shift of what the report says is seen with 80 % is seen so often, give or take four standard
// errors of 400 builds.
TEST(Regression, DeclaredPowerIsTheRealOne) {
  int caught = 0;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const std::vector<BaselineMetric> baseline = {{"max_tilt_deg", 0.8, Normals(2 * i, 100, 5.0)}};
    const double shift = Check(false, baseline, {Normals(2 * i + 1, 100, 5.0)}).rows[0].seen_80;
    const RegressionResult moved = Check(false, baseline, {Normals(2 * i + 1, 100, 5.0 + shift)});
    caught += moved.rows[0].verdict == RegressionVerdict::kChanged ? 1 : 0;
  }
  EXPECT_NEAR(caught / 400.0, 0.8, 0.09);
}

// A rate alone, as a family of 34 would hold it (m - 1 others that do not move).
RegressionRow RateRow(bool paired, const std::vector<double>& baseline,
                      const std::vector<double>& run) {
  const std::vector<BaselineMetric> metrics = {{"declared_success", 0.1, baseline}};
  const RegressionCell cell{.name = "", .paired = paired, .baseline = metrics, .run = {run}};
  return CheckRegression(std::span(&cell, 1), {.alpha = 0.01 / 34, .primary_share = 1.0}).rows[0];
}

// Builds of which a share of the trials, of `seen_80`, flips: caught 80 times of 100, give or take
// four standard errors of 400. Without a discordant pair a shift of 13 of 100, the least that the
// test rejects, is caught 54 times.
TEST(Regression, DeclaredPowerOfPairedRatesIsTheRealOne) {
  const double shift = RateRow(true, Ones(0, 100), Ones(0, 100)).seen_80;
  const auto caught = [](double share) {
    int count = 0;
    for (std::uint32_t i = 0; i < 400; ++i) {
      const std::vector<double> flips = Coins(900 + i, 100, share);
      const auto flipped = std::count(flips.begin(), flips.end(), 1.0);
      count += McNemarExactPValue(0, flipped) <= 0.01 / 34 ? 1 : 0;
    }
    return count / 400.0;
  };
  EXPECT_NEAR(caught(shift), 0.8, 0.09);
  EXPECT_LT(caught(0.13), 0.65) << "the control";
}

// Background of 5 % either way: the shift adds discordant pairs of its own, so that it is seen
// where fewer of them would not be.
TEST(Regression, DeclaredPowerOfDiscordantPairsIsExact) {
  std::vector<double> run = Ones(50, 100);
  for (std::size_t k = 45; k < 55; ++k) run[k] = 1.0 - run[k];
  const double shift = RateRow(true, Ones(50, 100), run).seen_80;
  EXPECT_NEAR(McNemarPower(100, {0.05, 0.05 + shift}, 0.01 / 34), 0.8, 0.005);
  EXPECT_LT(McNemarPower(100, {0.05, 0.05 + 0.141}, 0.01 / 34), 0.3) << "the control";
}

TEST(Regression, DeclaredPowerOfUnpairedRatesIsExact) {
  for (const int ones : {0, 5, 80, 100}) {
    const double rate = ones / 100.0;
    const RegressionRow row = RateRow(false, Ones(ones, 100), Ones(ones, 100));
    const double to = rate > 0.5 ? rate - row.seen_80 : rate + row.seen_80;
    EXPECT_NEAR(FisherPower(100, {rate, to}, 0.01 / 34), 0.8, 0.005) << ones;
    EXPECT_GT(row.seen_90, row.seen_80);
  }
  EXPECT_TRUE(std::isnan(RateRow(false, Ones(3, 5), Ones(3, 5)).seen_80)) << "five see nothing";
}

// Where an unchanged run of 20 pairs asks for this many, so many see a shift of the margin.
TEST(Regression, TrialsForTheMarginAreEnough) {
  const std::vector<double> few = Ones(10, 20);
  const RegressionRow paired = RateRow(true, few, few);
  EXPECT_NEAR(McNemarPower(paired.trials_for_margin, {0.0, 0.1}, 0.01 / 34), 0.8, 0.03);
  EXPECT_LT(paired.trials_for_margin, 200);
  const RegressionRow unpaired = RateRow(false, few, few);
  EXPECT_NEAR(FisherPower(unpaired.trials_for_margin, {0.5, 0.6}, 0.01 / 34), 0.8, 0.03);
}

}  // namespace
}  // namespace rockyard::statistics
