#include "statistics/regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/distributions.h"
#include "core/random.h"

namespace rockyard::statistics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> Normals(std::uint32_t set, std::size_t n, double mean) {
  core::RandomStream stream({.seed = 81, .trial = set}, core::Purpose::kTest);
  std::vector<double> values(n);
  for (double& x : values) x = core::SampleNormal(stream, mean, 1.0);
  return values;
}

std::vector<double> Coins(std::uint32_t set, std::size_t n, double rate) {
  core::RandomStream stream({.seed = 82, .trial = set}, core::Purpose::kTest);
  std::vector<double> values(n);
  for (double& x : values) x = core::SampleBernoulli(stream, rate) ? 1.0 : 0.0;
  return values;
}

// One metric with a mean and one rate.
RegressionResult Check(bool paired, const std::vector<BaselineMetric>& baseline,
                       std::vector<std::vector<double>> run) {
  const RegressionCell cell{
      .name = "cell", .paired = paired, .baseline = baseline, .run = std::move(run)};
  return CheckRegression(std::span(&cell, 1));
}

std::vector<BaselineMetric> Baseline(std::uint32_t set) {
  return {{"max_tilt_deg", 0.8, Normals(set, 100, 5.0)},
          {"declared_success", 0.2, Coins(set, 100, 0.8)}};
}

TEST(Regression, TheSameValuesAreEquivalentWithExitCodeZero) {
  const auto baseline = Baseline(1);
  const RegressionResult result = Check(true, baseline, {baseline[0].values, baseline[1].values});
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_EQ(result.Count(RegressionVerdict::kEquivalent), 2);
  EXPECT_EQ(ExitCode(result), 0);
}

// 400 unchanged builds with other seeds: any `changed` in at most 1 % of them, four standard errors
// more (alpha 3e-5).
TEST(Regression, FalseAlarmsStayBelowTheDeclaredRate) {
  int alarms = 0;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const auto baseline = Baseline(2 * i);
    const RegressionResult result =
        Check(false, baseline, {Normals(2 * i + 1, 100, 5.0), Coins(2 * i + 1, 100, 0.8)});
    alarms += result.Count(RegressionVerdict::kChanged) > 0 ? 1 : 0;
  }
  EXPECT_LE(alarms, 12);
}

// A shift of what the report says is seen with 80 % is seen so often, give or take four standard
// errors of 400 builds.
TEST(Regression, DeclaredPowerIsTheRealOne) {
  int caught = 0;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const auto baseline = Baseline(2 * i);
    const auto run_coins = Coins(2 * i + 1, 100, 0.8);
    const double shift =
        Check(false, baseline, {Normals(2 * i + 1, 100, 5.0), run_coins}).rows[0].seen_80;
    const RegressionResult moved =
        Check(false, baseline, {Normals(2 * i + 1, 100, 5.0 + shift), run_coins});
    caught += moved.rows[0].verdict == RegressionVerdict::kChanged ? 1 : 0;
  }
  EXPECT_NEAR(caught / 400.0, 0.8, 0.09);
}

TEST(Regression, FewTrialsAreInconclusiveWithExitCodeFour) {
  const std::vector<BaselineMetric> baseline = {{"max_tilt_deg", 0.5, Normals(1, 5, 5.0)}};
  const RegressionResult result = Check(false, baseline, {Normals(2, 5, 5.0)});
  ASSERT_EQ(result.rows.size(), 1u);
  EXPECT_EQ(result.rows[0].verdict, RegressionVerdict::kInconclusive);
  EXPECT_GT(result.rows[0].trials_for_margin, 5);
  EXPECT_EQ(ExitCode(result), 4);
}

TEST(Regression, AChangeHasExitCodeOneAlsoWhereItIsBelowItsMargin) {
  const std::vector<BaselineMetric> baseline = {{"max_tilt_deg", 2.0, Normals(1, 100, 5.0)}};
  std::vector<double> moved = baseline[0].values;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += i % 2 == 0 ? 0.4 : 0.6;
  const RegressionResult result = Check(true, baseline, {moved});
  EXPECT_EQ(result.rows[0].verdict, RegressionVerdict::kChanged);
  EXPECT_LT(result.rows[0].equivalence_p_value, 0.05);
  EXPECT_EQ(ExitCode(result), 1);
  EXPECT_NEAR(result.rows[0].difference, 0.5, 1e-12);
}

TEST(Regression, PairsNeedAValueOnBothSides) {
  const std::vector<BaselineMetric> baseline = {{"max_tilt_deg", 2.0, {1.0, kNaN, 3.0, 4.0}}};
  const RegressionResult result = Check(true, baseline, {{1.5, 2.0, kNaN, 4.5, 9.0}});
  EXPECT_EQ(result.rows[0].baseline_count, 2);
  EXPECT_EQ(result.rows[0].run_count, 2);
}

TEST(Regression, NothingToCompareIsInconclusive) {
  const std::vector<BaselineMetric> baseline = {{"max_tilt_deg", 2.0, {kNaN, kNaN}}};
  EXPECT_TRUE(Check(false, baseline, {{}}).rows.empty());
  EXPECT_EQ(ExitCode(Check(false, baseline, {{}})), 4);
}

TEST(Regression, RoundingKeepsFiveDigits) {
  EXPECT_EQ(RoundForBaseline(1.2345678), 1.2346);
  EXPECT_EQ(RoundForBaseline(-123456.0), -123460.0);
  EXPECT_TRUE(std::isnan(RoundForBaseline(kNaN)));
}

}  // namespace
}  // namespace rockyard::statistics
