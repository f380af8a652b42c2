// Numbers that are judged by a tolerance: verdicts, intervals and closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "core/json_file.h"
#include "core/random.h"
#include "statistics/closed_forms.h"
#include "statistics/published_comparison.h"
#include "truth/measured_schema.h"

namespace rockyard::statistics {
namespace {

using truth::Record;
using truth::TrialOutcome;

TEST(ClosedForms, AgreeWithThePublishedArithmetic) {
  EXPECT_NEAR(AnyOf(0.01, 20), 1.0 - std::pow(0.99, 20), 1e-15);
  EXPECT_NEAR(AnyOf(1e-12, 20), 2e-11, 1e-21) << "no cancellation";
  EXPECT_NEAR(NetRate(0.065, 0.0067, 20.0), 0.002188, 5e-7);
  EXPECT_NEAR(RangeResolution(0.0029, 0.3, 0.12), 0.002175, 1e-12);
  const double power[] = {2.01, 3.77, 0.75, 0.80};
  EXPECT_NEAR(Evaluate(Formula::kSum, power), 7.33, 1e-12);
  const double energy[] = {7.33, 20.0};
  EXPECT_NEAR(Evaluate(Formula::kProduct, energy), 146.6, 1e-9);
  EXPECT_NEAR(Evaluate(Formula::kQuotient, energy), 0.3665, 1e-12);
}

// Numbers and cover of Moore's law, computed independently.
TEST(ClosedForms, PowerLaws) {
  const core::JsonValue oracles =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/moore_oracles.json");
  for (const char* terrain : {"vl2", "nominal"}) {
    const core::JsonValue& oracle = *oracles.Find(terrain);
    const double k = oracle.Find("k")->number();
    for (const core::JsonValue& row : oracle.Find("number_per_m2")->list()) {
      const double inputs[] = {k, row.Find("diameter_m")->number(), 2.66};
      const double number = row.Find("number")->number();
      EXPECT_NEAR(Evaluate(Formula::kPowerLaw, inputs), number, 1e-12 * number);
    }
    const double cover = oracle.Find("cover_from_0.1_m_to_infinity")->number();
    const double inputs[] = {k, 0.1, 2.66};
    EXPECT_NEAR(Evaluate(Formula::kPowerLawCover, inputs), cover, 1e-12);
    const double other[] = {k, 0.1, 2.7};
    EXPECT_GT(std::abs(Evaluate(Formula::kPowerLawCover, other) - cover), 0.04 * cover);
  }
  const double endless[] = {0.013, 0.1, 2.0};
  EXPECT_FALSE(InDomain(Formula::kPowerLawCover, endless)) << "the integral does not converge";
}

// Exact moments of the state equations by double sums of another program.
TEST(ClosedForms, DriftOfAStraightDrive) {
  const core::JsonValue oracles =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/drift/drift_exact.json");
  for (const double distance_m : {5.0, 7.0, 10.0, 15.0, 20.0, 40.0}) {
    const core::JsonValue* exact =
        oracles.Find("rocky32_0.70@" + std::to_string(std::lround(distance_m)) + "m");
    ASSERT_NE(exact, nullptr);
    const double inputs[] = {0.067, distance_m, 0.0039, 0.70};
    EXPECT_NEAR(Evaluate(Formula::kDriftAlong, inputs), exact->Find("sd_x")->number(), 1e-9);
    EXPECT_NEAR(Evaluate(Formula::kDriftAcross, inputs), exact->Find("sd_y")->number(), 1e-9);
    const double other[] = {0.067, distance_m, 0.0039, 0.77};
    EXPECT_GT(Evaluate(Formula::kDriftAcross, other), 1.04 * exact->Find("sd_y")->number());
  }
  const double no_step[] = {0.0, 10.0, 0.0039, 0.70};
  EXPECT_FALSE(InDomain(Formula::kDriftAlong, no_step));
  const double endless[] = {0.067, 1e6, 0.0039, 0.70};
  EXPECT_FALSE(InDomain(Formula::kDriftAcross, endless));
}

PublishedValue Value(StatisticKind statistic, double low, double high) {
  PublishedValue value;
  value.id = "value";
  value.scenario = "run";
  value.statistic = statistic;
  value.column = "alarm_single";
  value.of = "scenes";
  value.low = low;
  value.high = high;
  return value;
}

truth::RecordSchema Schema() {
  constexpr std::string_view kNames[] = {"height_m", "scenes", "alarm_single"};
  return truth::MeasuredSchema(kNames);
}

// One run a cell, of the given number of scenes, alarms as the rates say on average.
std::vector<Record> Runs(const std::vector<double>& rates, double scenes, std::uint32_t seed) {
  std::vector<Record> records;
  core::RandomStream stream({seed, 0}, core::Purpose::kTest);
  for (std::size_t i = 0; i < rates.size(); ++i) {
    double count = 0.0;
    for (int k = 0; k < static_cast<int>(scenes); ++k) {
      count += core::SampleBernoulli(stream, rates[i]) ? 1.0 : 0.0;
    }
    const auto cell = static_cast<double>(i);
    records.push_back({i, TrialOutcome::kMeasured, "", {cell, 0.01 * cell, scenes, count}});
  }
  return records;
}

ComparedValue CompareOne(const PublishedValue& value, const std::vector<Record>& records,
                         const truth::RecordSchema& schema = Schema()) {
  PublishedReference reference;
  reference.values.push_back(value);
  const ScenarioRun run{"run", schema, records};
  return Compare(reference, {&run, 1}).values.front();
}

// Of a rate that is to lie within the tolerance.
Verdict VerdictOf(double low, double high, const std::vector<Record>& records) {
  return CompareOne(Value(StatisticKind::kRate, low, high), records).verdict;
}

TEST(Tolerances, InsideAgreesApartDiffersAcrossIsUnderpowered) {
  const std::vector<Record> records = Runs({0.3}, 10000, 1);
  EXPECT_EQ(VerdictOf(0.25, 0.35, records), Verdict::kAgrees);
  EXPECT_EQ(VerdictOf(0.0, 0.25, records), Verdict::kDiffers);
  EXPECT_EQ(VerdictOf(0.35, 1.0, records), Verdict::kDiffers);
  EXPECT_EQ(VerdictOf(0.301, 1.0, records), Verdict::kUnderpowered);
}

// What no simulation can miss is not agreement.
TEST(Tolerances, OneThatHoldsEveryRateHolds) {
  const std::vector<Record> records = Runs({0.3}, 10000, 1);
  EXPECT_EQ(VerdictOf(0.0, 1.0, records), Verdict::kHolds);
  EXPECT_EQ(VerdictOf(0.0, 0.99, records), Verdict::kAgrees);
  EXPECT_EQ(VerdictOf(0.01, 1.0, records), Verdict::kAgrees);
}

TEST(Tolerances, IntervalsCoverTheTruthAsOftenAsTheySay) {
  // 400 pools of a rate 0.05: 95 % exact intervals miss at most 5 %; 0.0001 is the chance to see
  // 38 or more of 400. Negative control: they miss a rate that is a quarter higher far more often.
  int missed = 0;
  int missed_other = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const ComparedValue value =
        CompareOne(Value(StatisticKind::kRate, 0.0, 1.0), Runs({0.05}, 2000, seed));
    missed += value.interval.low > 0.05 || value.interval.high < 0.05 ? 1 : 0;
    missed_other += value.interval.low > 0.0625 || value.interval.high < 0.0625 ? 1 : 0;
  }
  EXPECT_LT(missed, 38);
  EXPECT_GT(missed_other, 150);
}

// 40 runs of 50 trials. With `clustered`, all ten trials of a drive end alike, five drives a run.
std::vector<Record> Drives(bool clustered, double rate, std::uint32_t seed) {
  constexpr int kDrives = 5;
  constexpr int kOfDrive = 10;
  std::vector<Record> records;
  core::RandomStream stream({seed, 1}, core::Purpose::kTest);
  for (std::uint32_t run = 0; run < 40; ++run) {
    double count = 0.0;
    for (int drive = 0; drive < (clustered ? kDrives : kDrives * kOfDrive); ++drive) {
      if (core::SampleBernoulli(stream, rate)) count += clustered ? kOfDrive : 1;
    }
    records.push_back({run, TrialOutcome::kMeasured, "", {0.0, kDrives * kOfDrive, count}});
  }
  return records;
}

ComparedValue Missed(const std::vector<Record>& records) {
  constexpr std::string_view kNames[] = {"hazards", "missed"};
  PublishedValue value = Value(StatisticKind::kRate, 0.0, 1.0);
  value.column = "missed";
  value.of = "hazards";
  return CompareOne(value, records, truth::MeasuredSchema(kNames));
}

TEST(Tolerances, HazardsOfOneDriveAreNotIndependent) {
  // 400 pools of clustered trials at rate 0.1: a nominal 95 % interval is missed 20 times on
  // average and 38 times or more with chance 0.0001. Negative control: the same counts as
  // independent scenes (binomial) are missed far more often, as the design effect is ten.
  int missed = 0;
  int missed_as_scenes = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    const std::vector<Record> drives = Drives(true, 0.1, seed);
    const Interval interval = Missed(drives).interval;
    missed += interval.low > 0.1 || interval.high < 0.1 ? 1 : 0;
    std::vector<Record> scenes;
    for (const Record& drive : drives) {
      scenes.push_back(
          {drive.trial, TrialOutcome::kMeasured, "", {0.0, 0.0, drive.values[1], drive.values[2]}});
    }
    const Interval binomial = CompareOne(Value(StatisticKind::kRate, 0.0, 1.0), scenes).interval;
    missed_as_scenes += binomial.low > 0.1 || binomial.high < 0.1 ? 1 : 0;
  }
  EXPECT_LT(missed, 38);
  EXPECT_GT(missed_as_scenes, 150);
}

TEST(Tolerances, IndependentHazardsLoseLittle) {
  const Interval interval = Missed(Drives(false, 0.1, 3)).interval;
  const Interval wide = Missed(Drives(true, 0.1, 3)).interval;
  // Binomial width at 0.1 of 2000: 2 x 1.96 sqrt(0.09 / 2000) = 0.0263; clustered sqrt(10) more.
  EXPECT_NEAR(interval.high - interval.low, 0.0263, 0.008);
  EXPECT_NEAR(wide.high - wide.low, 0.083, 0.025);
}

TEST(Tolerances, WithoutAnEventTheRateMayStillBeAboveZero) {
  const Interval none = Missed(Drives(true, 0.0, 1)).interval;
  EXPECT_EQ(none.low, 0.0);
  EXPECT_GT(none.high, 3.69 / 2000) << "exact upper end of 0 of 2000, 95 % two-sided: 0.00184";
  const std::vector<Record> one_run{Drives(true, 0.1, 1).front()};
  EXPECT_EQ(Missed(one_run).interval.high, 1.0) << "one run of dependent trials says nothing";
}

TEST(Tolerances, ManyNumbersShareTheLevel) {
  const std::vector<Record> records = Runs({0.3}, 1000, 1);
  PublishedReference reference;
  for (const char* id : {"a", "b", "c", "d", "e"}) {
    reference.values.push_back(Value(StatisticKind::kRate, 0.0, 1.0));
    reference.values.back().id = id;
  }
  const ScenarioRun run{"run", Schema(), records};
  const ComparisonResult five = Compare(reference, {&run, 1});
  const ComparedValue one = CompareOne(reference.values[0], records);
  EXPECT_DOUBLE_EQ(five.values[0].level, 0.01);
  EXPECT_LT(five.values[0].interval.low, one.interval.low);
  EXPECT_EQ(five.family, 0u) << "no row of Holm's procedure";
}

TEST(Tolerances, OnlyRecordsInRangeCount) {
  const auto where = [](const char* column, double low, double high) {
    PublishedValue value = Value(StatisticKind::kRate, 0.8, 1.0);
    value.where = {{column, low, high}};
    return CompareOne(value, Runs({0.1, 0.9}, 1000, 1)).verdict;
  };
  EXPECT_EQ(where("height_m", 0.009, 0.011), Verdict::kAgrees);
  EXPECT_EQ(where("height_m", -0.001, 0.001), Verdict::kDiffers);
  EXPECT_EQ(where("height_m", 5.0, 6.0), Verdict::kNotJudged);
  EXPECT_EQ(where("no_such_column", 5.0, 6.0), Verdict::kNotJudged);
}

TEST(Tolerances, ACrossingLiesWhereTheCurvePassesTheLevel) {
  PublishedValue value = Value(StatisticKind::kCrossing, 0.9, 1.1);
  value.along = "height_m";
  value.factor = 100.0 / 1.5;
  // 0.1 at 0.00, 0.25 at 0.01, 0.75 at 0.02, 0.9 at 0.03: one half at 0.015.
  const std::vector<Record> records = Runs({0.1, 0.25, 0.75, 0.9}, 10000, 3);
  const ComparedValue found = CompareOne(value, records);
  EXPECT_NEAR(found.pool_value, 1.0, 0.03);
  EXPECT_LT(found.interval.low, found.pool_value);
  EXPECT_GT(found.interval.high, found.pool_value);
  EXPECT_EQ(found.verdict, Verdict::kAgrees);
  value.low = 1.2;
  value.high = 1.8;
  EXPECT_EQ(CompareOne(value, records).verdict, Verdict::kDiffers);
  value.level = 0.99;
  EXPECT_EQ(CompareOne(value, records).verdict, Verdict::kDiffers) << "never reached: infinite";
}

TEST(Tolerances, RatiosAndMeansTakeTheScatterOfTheRuns) {
  PublishedValue ratio = Value(StatisticKind::kRatio, 0.55, 0.65);
  ratio.factor = 2.0;
  const std::vector<Record> records = Runs(std::vector<double>(50, 0.3), 500, 9);
  const ComparedValue of_runs = CompareOne(ratio, records);
  EXPECT_NEAR(of_runs.pool_value, 0.6, 0.02);
  EXPECT_EQ(of_runs.verdict, Verdict::kAgrees);
  // Binomial runs: the interval of the ratio is that of the rate, twice as wide by the factor.
  const ComparedValue as_rate = CompareOne(Value(StatisticKind::kRate, 0.0, 1.0), records);
  const double width = of_runs.interval.high - of_runs.interval.low;
  EXPECT_NEAR(width / (2.0 * (as_rate.interval.high - as_rate.interval.low)), 1.0, 0.3);

  PublishedValue mean = Value(StatisticKind::kMean, 499.0, 501.0);
  mean.column = "scenes";
  mean.of.clear();
  const ComparedValue exact = CompareOne(mean, records);
  EXPECT_EQ(exact.interval.low, 500.0);
  EXPECT_EQ(exact.interval.high, 500.0);
  EXPECT_EQ(exact.verdict, Verdict::kAgrees);
}

truth::RecordSchema Named(std::initializer_list<const char*> names) {
  truth::RecordSchema schema;
  for (const char* name : names) schema.push_back({name, "1", "for this test"});
  return schema;
}

PublishedValue SumOf(const decltype(PublishedValue::terms)& terms, double low, double high) {
  PublishedValue value;
  value.id = "sum";
  value.scenario = "run";
  value.statistic = StatisticKind::kRatioSum;
  value.terms = terms;
  value.low = low;
  value.high = high;
  return value;
}

// Two terms, by hand: (10 + 20 + 5 + 15) / (2 + 3) + (7 + 2) / (1 + 2) = 10 + 3, times 2.
TEST(Tolerances, RatiosOfSumsAddUp) {
  const std::vector<Record> records{{0, TrialOutcome::kMeasured, "", {10.0, 20.0, 2.0, 7.0, 1.0}},
                                    {1, TrialOutcome::kMeasured, "", {5.0, 15.0, 3.0, 2.0, 2.0}}};
  PublishedValue value = SumOf({{{"a", "b"}, "looks"}, {{"c"}, "moves"}}, 25.0, 27.0);
  value.factor = 2.0;
  const truth::RecordSchema schema = Named({"a", "b", "looks", "c", "moves"});
  const ComparedValue sum = CompareOne(value, records, schema);
  EXPECT_NEAR(sum.pool_value, 26.0, 1e-12);
  // Residuals of both runs: (30 - 10 x 2) / 2.5 + (7 - 3 x 1) / 1.5 = 20/3, and -20/3. Their
  // standard deviation is 20/3 sqrt(2), t of one degree of freedom at 0.975 is 12.7062.
  EXPECT_NEAR(sum.interval.high - sum.pool_value, 2.0 * 12.7062 * 20.0 / 3.0, 1e-3);
  EXPECT_EQ(sum.verdict, Verdict::kUnderpowered);

  value.terms[1].of = "no_such_column";
  EXPECT_EQ(CompareOne(value, records, schema).verdict, Verdict::kNotJudged);
}

// A run that looks longer and drives shorter scatters in each term, not in their sum.
TEST(Tolerances, TermsThatGoTogetherInARunAreTakenTogether) {
  std::vector<Record> records;
  for (std::uint32_t i = 0; i < 10; ++i) {
    const double shift = i % 2 == 0 ? 3.0 : -3.0;
    records.push_back({i, TrialOutcome::kMeasured, "", {20.0 + shift, 1.0, 15.0 - shift, 1.0}});
  }
  const auto verdict = [&](const PublishedValue& value) {
    return CompareOne(value, records, Named({"a", "looks", "c", "moves"})).verdict;
  };
  EXPECT_EQ(verdict(SumOf({{{"a"}, "looks"}, {{"c"}, "moves"}}, 34.9, 35.1)), Verdict::kAgrees);
  EXPECT_EQ(verdict(SumOf({{{"a"}, "looks"}}, 19.9, 20.1)), Verdict::kUnderpowered);
}

TEST(Tolerances, WhatIsComputedNeedsNoRun) {
  PublishedValue value;
  value.id = "computed";
  value.statistic = StatisticKind::kComputed;
  value.formula = Formula::kAnyOf;
  value.inputs = {0.01, 20.0};
  value.low = 0.16;
  value.high = 0.20;
  PublishedReference reference{.values = {value}};
  const ComparedValue inside = Compare(reference, {}).values.front();
  EXPECT_EQ(inside.verdict, Verdict::kHolds);
  EXPECT_NEAR(inside.pool_value, 0.1821, 1e-4);
  reference.values[0].inputs = {0.02, 20.0};
  EXPECT_EQ(Compare(reference, {}).values.front().verdict, Verdict::kDiffers);
}

}  // namespace
}  // namespace rockyard::statistics
