#include "statistics/regression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/random.h"
#include "statistics/equivalence.h"
#include "statistics/sample_size.h"

namespace rockyard::statistics {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> Normals(std::uint32_t set, std::size_t n, double mean) {
  core::RandomStream stream({.seed = 81, .trial = set}, core::Purpose::kTest);
  std::vector<double> values(n);
  for (double& x : values) x = core::SampleNormal(stream, mean, 1.0);
  return values;
}

std::vector<double> Coins(std::uint32_t set, std::size_t n, double rate, std::uint64_t seed = 82) {
  core::RandomStream stream({.seed = seed, .trial = set}, core::Purpose::kTest);
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

std::vector<double> Ones(int ones, int n) {
  std::vector<double> values(static_cast<std::size_t>(n), 0.0);
  std::fill_n(values.begin(), ones, 1.0);
  return values;
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

// The same for a family of many metrics, most of whose level Holm's procedure takes: without it two
// in ten of these builds would raise an alarm. At most 1 %, and four standard errors of 400 more.
TEST(Regression, AFamilyOfMetricsRaisesNoMoreAlarmsThanOne) {
  std::vector<std::string> names;
  for (const Metric& metric : Metrics()) {
    if (metric.kind == MetricKind::kMean) names.emplace_back(metric.name);
  }
  ASSERT_GT(names.size(), 15u);
  int alarms = 0;
  int without_holm = 0;
  std::uint32_t set = 5000;
  for (int i = 0; i < 400; ++i) {
    std::vector<BaselineMetric> baseline;
    std::vector<std::vector<double>> run;
    for (const std::string& name : names) {
      baseline.push_back({name, 1.0, Normals(set++, 30, 5.0)});
      run.push_back(Normals(set++, 30, 5.0));
    }
    const RegressionResult result = Check(false, baseline, std::move(run));
    alarms += result.Count(RegressionVerdict::kChanged) > 0 ? 1 : 0;
    without_holm += std::any_of(result.rows.begin(), result.rows.end(),
                                [](const auto& row) { return row.p_value <= 0.01; });
  }
  EXPECT_LE(alarms, 12);
  EXPECT_GT(without_holm, 40) << "the control";
}

// Skewed counts, most of them 0, in a run of another size than the baseline: nominal level of one
// of 34 metrics. Welch's test of 400 against 50 raises an alarm in 8 % of these.
TEST(Regression, RunsOfAnotherSizeKeepTheLevelWhereValuesAreSkewed) {
  const auto counts = [](std::uint32_t set, std::size_t n) { return Coins(set, n, 0.05, 83); };
  constexpr double kLevel = 0.01 / 34;
  int alarms = 0;
  int welch_alarms = 0;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const std::vector<BaselineMetric> baseline = {{"scrapes", 0.5, counts(2 * i, 400)}};
    const std::vector<double> run = counts(2 * i + 1, 50);
    alarms += Check(false, baseline, {run}).rows[0].p_value <= kLevel ? 1 : 0;
    welch_alarms += ChangePValue(WelchMeans(baseline[0].values, run)) <= kLevel ? 1 : 0;
  }
  EXPECT_LE(alarms, 3) << "0.3 are expected at most; 4 or more have a chance of 3e-4";
  EXPECT_GT(welch_alarms, 30) << "the control";
}

TEST(Regression, BothSidesEnterWithEquallyManyValues) {
  const RegressionResult result =
      Check(false, Baseline(1), {Normals(2, 300, 5.0), Coins(2, 300, 0.8)});
  for (const RegressionRow& row : result.rows) {
    EXPECT_EQ(row.baseline_count, 100);
    EXPECT_EQ(row.run_count, 100);
  }
}

TEST(Regression, IdenticalRunsAreEquivalentHoweverFew) {
  const std::vector<BaselineMetric> baseline = {{"heading_error_deg", 0.5, Normals(1, 5, 5.0)},
                                                {"declared_success", 0.1, Coins(1, 5, 0.8)}};
  RegressionCell cell{.name = "",
                      .paired = true,
                      .identical = true,
                      .baseline = baseline,
                      .run = {baseline[0].values, baseline[1].values}};
  EXPECT_EQ(ExitCode(CheckRegression(std::span(&cell, 1))), 0);
  cell.run[0][2] += 0.1;  // a metric that this program defines in another way
  EXPECT_EQ(ExitCode(CheckRegression(std::span(&cell, 1))), 4);
  cell = {.name = "",
          .paired = true,
          .baseline = baseline,
          .run = {baseline[0].values, baseline[1].values}};
  EXPECT_EQ(ExitCode(CheckRegression(std::span(&cell, 1))), 4) << "the control";
}

TEST(Regression, WhatTheRunLacksIsNotPassedOver) {
  const std::vector<BaselineMetric> baseline = {{"max_tilt_deg", 0.5, Normals(1, 50, 5.0)}};
  for (const bool paired : {true, false}) {
    const RegressionResult result = Check(paired, baseline, {{}});
    ASSERT_EQ(result.rows.size(), 1u);
    EXPECT_EQ(result.rows[0].baseline_count, 50);
    EXPECT_EQ(result.rows[0].run_count, 0);
    EXPECT_EQ(ExitCode(result), 4);
  }
  // Other trials arrived: no pair has a value on both sides.
  std::vector<double> first = Normals(1, 50, 5.0);
  std::vector<double> second = Normals(1, 50, 5.0);
  for (std::size_t i = 0; i < 50; ++i) (i < 25 ? first : second)[i] = kNaN;
  EXPECT_EQ(ExitCode(Check(true, {{{"heading_error_deg", 0.5, first}}}, {second})), 4);
}

// A change that tilts one trial in twenty by 45 degrees moves the mean by more than the margin. It
// is called equivalent in at most 5 % of all builds, and four standard errors of 400 more.
TEST(Regression, RareLargeChangesAreSeldomCalledEquivalent) {
  for (const std::size_t n : {10u, 20u, 40u, 100u}) {
    int equivalent = 0;
    int student = 0;
    for (std::uint32_t i = 0; i < 400; ++i) {
      std::vector<double> baseline = Normals(i, n, 5.0);
      for (double& x : baseline) x *= 8.0;  // from some 16 to 64 degrees
      const std::vector<double> hits = Coins(3000 + i, n, 0.05);
      std::vector<double> run = baseline;
      for (std::size_t k = 0; k < n; ++k) run[k] += 45.0 * hits[k];
      const RegressionResult result = Check(true, {{{"max_tilt_deg", 2.0, baseline}}}, {run});
      equivalent += result.rows[0].verdict == RegressionVerdict::kEquivalent ? 1 : 0;
      std::vector<double> moved(n);
      for (std::size_t k = 0; k < n; ++k) moved[k] = 45.0 * hits[k];
      student += EquivalencePValue(PairedMeans(moved), 2.0) <= 0.05 ? 1 : 0;
    }
    EXPECT_LE(equivalent, 37) << n;
    EXPECT_GT(student, 37) << n << ": the control, a standard error of what was seen";
  }
}

// Two groups of a coin's values without scatter are no evidence.
TEST(Regression, FewValuesWithoutScatterAreNoChange) {
  const RegressionResult few = Check(false, {{{"max_tilt_deg", 0.5, Ones(5, 5)}}}, {Ones(0, 5)});
  EXPECT_EQ(few.rows[0].verdict, RegressionVerdict::kInconclusive);
  EXPECT_EQ(Check(false, {{{"max_tilt_deg", 0.5, Ones(30, 30)}}}, {Ones(0, 30)}).rows[0].verdict,
            RegressionVerdict::kChanged);
  // All zero, of both: shown only where a change in a twentieth of the trials would have been seen.
  EXPECT_EQ(ExitCode(Check(false, {{{"heading_error_deg", 0.5, Ones(0, 40)}}}, {Ones(0, 40)})), 4);
  EXPECT_EQ(ExitCode(Check(false, {{{"heading_error_deg", 0.5, Ones(0, 60)}}}, {Ones(0, 60)})), 0);
}

TEST(Regression, FewTrialsAreInconclusiveWithExitCodeFour) {
  const std::vector<BaselineMetric> baseline = {{"heading_error_deg", 0.5, Normals(1, 5, 5.0)}};
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

// The primary family is a list of metrics that exist.
TEST(RegressionFamilies, ThePrimaryOneHasSuccessDistanceTimeAndErrors) {
  std::vector<std::string_view> primary;
  for (const Metric& metric : Metrics()) {
    if (IsPrimary(metric)) primary.push_back(metric.name);
  }
  EXPECT_EQ(primary, (std::vector<std::string_view>{
                         "declared_success", "true_success", "true_distance_m", "active_time_s",
                         "distance_error_percent", "heading_error_deg", "position_error_m"}));
}

// A primary metric beside 19 secondary ones is held against the primary part of alpha, whatever the
// others say, and a secondary one against a nineteenth of its family's part.
TEST(RegressionFamilies, EachHasItsOwnLevel) {
  std::vector<BaselineMetric> baseline = {{"declared_success", 0.1, Ones(50, 100)}};
  std::vector<std::vector<double>> run = {Ones(50, 100)};
  for (const Metric& metric : Metrics()) {
    if (IsPrimary(metric) || metric.kind != MetricKind::kMean || run.size() > 19) continue;
    baseline.push_back({std::string(metric.name), 0.8, Normals(7, 100, 5.0)});
    run.push_back(Normals(8, 100, 5.0));
  }
  ASSERT_EQ(run.size(), 20u);
  const RegressionResult result = Check(false, baseline, run);
  for (const RegressionRow& row : result.rows) {
    EXPECT_DOUBLE_EQ(row.level, row.primary ? 0.008 : 0.002 / 19) << row.metric.name;
  }
  // Without families success would be one of 20.
  EXPECT_GT(result.rows[0].level, 0.01 / 20);
}

// What is undecided in the secondary family leaves the check decided; a change there does not.
TEST(RegressionFamilies, SecondaryMetricsDecideByAChangeOnly) {
  const std::vector<double> few = Normals(1, 100, 5.0);
  const auto check = [&](double moved, const char* name) {
    std::vector<double> run = Normals(2, 100, 5.0 + moved);
    return Check(false, {{name, 1e-3, few}, {"declared_success", 0.3, Ones(50, 100)}},
                 {run, Ones(50, 100)});
  };
  const RegressionResult wide = check(0.3, "max_tilt_deg");
  EXPECT_EQ(wide.rows[0].verdict, RegressionVerdict::kInconclusive);
  EXPECT_EQ(wide.Count(RegressionVerdict::kInconclusive, false), 1);
  EXPECT_EQ(ExitCode(wide), 0);
  EXPECT_EQ(ExitCode(check(0.3, "heading_error_deg")), 4) << "the control";
  EXPECT_EQ(ExitCode(check(3.0, "max_tilt_deg")), 1);
}

// 100 coins against 100 are not shown to be equivalent within 0.3, but a shift of 0.3 would have
// been seen; one of 0.2 would not.
TEST(RegressionFamilies, NoneSeenIsForWhatWouldHaveBeenSeen) {
  const auto verdict = [](double margin) {
    const RegressionResult result =
        Check(false, {{"declared_success", margin, Ones(50, 100)}}, {Ones(33, 100)});
    EXPECT_EQ(result.rows[0].to_see, margin);
    EXPECT_EQ(result.rows[0].verdict == RegressionVerdict::kNoneSeen,
              result.rows[0].seen_80 <= margin)
        << result.rows[0].seen_80;
    return result.rows[0].verdict;
  };
  EXPECT_EQ(verdict(0.27), RegressionVerdict::kNoneSeen);
  EXPECT_EQ(verdict(0.2), RegressionVerdict::kInconclusive);
}

// Of a mean what matters is its margin, and half a standard deviation where that is more.
TEST(RegressionFamilies, AMeanIsHeldAgainstItsScatter) {
  const auto row = [](std::size_t n, double margin) {
    return Check(false, {{"heading_error_deg", margin, Normals(1, n, 5.0)}}, {Normals(2, n, 5.0)})
        .rows[0];
  };
  EXPECT_NEAR(row(200, 0.01).to_see, 0.5, 0.06);
  EXPECT_EQ(row(200, 0.01).verdict, RegressionVerdict::kNoneSeen);
  EXPECT_EQ(row(60, 0.01).verdict, RegressionVerdict::kInconclusive) << "the control";
  EXPECT_EQ(row(200, 0.9).to_see, 0.9);
}

// Of 400 pairs 10 differ: Student's law says nothing of them, but so few cannot hide half a
// standard deviation. Of 40 pairs 1 could.
TEST(RegressionFamilies, FewDifferingPairsAreNoneSeenWhereTheirNumberExcludesAChange) {
  const auto row = [](std::size_t n) {
    const std::vector<double> baseline = Normals(1, n, 5.0);
    std::vector<double> run = baseline;
    for (std::size_t i = 0; i < n; i += 40) run[i] += i % 80 == 0 ? 0.5 : -0.5;
    return Check(true, {{"heading_error_deg", 1e-3, baseline}}, {run}).rows[0];
  };
  EXPECT_EQ(row(400).verdict, RegressionVerdict::kNoneSeen);
  EXPECT_TRUE(std::isnan(row(400).seen_80));
  EXPECT_EQ(row(40).verdict, RegressionVerdict::kInconclusive) << "the control";
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
