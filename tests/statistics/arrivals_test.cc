// Published sets of which a known number of runs arrived, and the power of statistics of quantities
// with a lower limit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "statistics/predictive.h"
#include "statistics/published_comparison.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

using truth::Record;
using truth::TrialOutcome;

constexpr std::size_t kReplicates = 5000;

PublishedValue Value(StatisticKind statistic, std::int64_t arrived, double value) {
  PublishedValue published;
  published.id = "x";
  published.scenario = "run";
  published.statistic = statistic;
  published.sample_size = 40;
  published.arrived = arrived;
  published.value = value;
  published.column = "x";
  return published;
}

// Uniform values: below 1 of runs that arrive, and of every third run, which does not, below
// `others`.
std::vector<Record> Uniforms(double others, std::uint32_t count = 6000) {
  std::vector<Record> records;
  core::RandomStream stream({3, 1}, core::Purpose::kTest);
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool arrives = i % 3 != 0;
    records.push_back({i,
                       arrives ? TrialOutcome::kFalseGoal : TrialOutcome::kJammed,
                       "",
                       {stream.Uniform() * (arrives ? 1.0 : others)}});
  }
  return records;
}

ComparedValue CompareOne(const PublishedValue& value, const std::vector<Record>& records) {
  PublishedReference reference{.values = {value}};
  const ScenarioRun run{"run", {{"x", "1", "a number"}, {"base", "1", "another"}}, records};
  return Compare(reference, {&run, 1}, {.seed = 1, .replicates = kReplicates}).values.front();
}

// With 39 arrivals P(maximum <= x) = x^39 min(x, 2) / 2: 1 - .95 at x = .928, .975 at 1.95; over
// all runs, of which a third reach 2, it is far beyond 1.
TEST(ByArrival, MaximumOfThirtyNineAndOneInClosedForm) {
  const std::vector<Record> records = Uniforms(2.0);
  const ComparedValue row = CompareOne(Value(StatisticKind::kMaximum, 39, 0.95), records);
  EXPECT_GT(row.interval.low, 1.3);
  ASSERT_EQ(row.beside.size(), 1u);
  EXPECT_EQ(row.beside[0].name, "39 arrivals of 40");
  EXPECT_NEAR(row.beside[0].interval.low, std::pow(0.05, 1.0 / 40.0), 0.01);
  EXPECT_NEAR(row.beside[0].interval.high, 1.95, 0.02);
  // Twice P(maximum <= .95); over all runs there is hardly any such set.
  EXPECT_NEAR(row.beside[0].p_value, std::pow(0.95, 40.0), 0.03);
  EXPECT_LT(row.p_value, 0.002);
}

TEST(ByArrival, RowsAreJudgedOverAllRuns) {
  const std::vector<Record> records = Uniforms(2.0);
  const ComparedValue with = CompareOne(Value(StatisticKind::kMinimum, 39, 0.5), records);
  const ComparedValue without = CompareOne(Value(StatisticKind::kMinimum, 0, 0.5), records);
  EXPECT_EQ(with.p_value, without.p_value);
  EXPECT_EQ(with.power, without.power);
  EXPECT_EQ(with.verdict, without.verdict);
  EXPECT_EQ(with.interval.high, without.interval.high);
  EXPECT_EQ(with.beside.size(), without.beside.size() + 1);
}

// Where all runs arrived, what the others do does not matter; where one did not, it does.
TEST(ByArrival, ExtremeFailuresEnterOnce) {
  const std::vector<Record> records = Uniforms(1e6);
  const ComparedValue all = CompareOne(Value(StatisticKind::kMaximum, 40, 1.0), records);
  EXPECT_LT(all.beside.at(0).interval.high, 1.01);
  const ComparedValue one = CompareOne(Value(StatisticKind::kMaximum, 39, 1.0), records);
  EXPECT_GT(one.beside.at(0).interval.low, 1.01);
  const ComparedValue mode = CompareOne(Value(StatisticKind::kMode, 39, 0.5), records);
  EXPECT_LT(mode.beside.back().interval.high, 1.0);
}

TEST(ByArrival, NegativeCounts) {
  std::vector<Record> records = Uniforms(1.0);
  for (Record& record : records) {
    if (record.outcome == TrialOutcome::kJammed) record.values[0] *= -1.0;
  }
  const ComparedValue row = CompareOne(Value(StatisticKind::kNegativeCount, 38, 2), records);
  EXPECT_NEAR(row.median, 13.0, 1.0);
  ASSERT_EQ(row.beside.size(), 1u);
  EXPECT_EQ(row.beside[0].interval.low, 2.0);
  EXPECT_EQ(row.beside[0].interval.high, 2.0);
  EXPECT_GT(row.beside[0].p_value, 0.9);
  EXPECT_LT(CompareOne(Value(StatisticKind::kNegativeCount, 38, 4), records).beside[0].p_value,
            0.01);
}

TEST(ByArrival, ExponentialStatementOfArrivals) {
  std::vector<Record> records;
  core::RandomStream stream({4, 1}, core::Purpose::kTest);
  for (std::uint32_t i = 0; i < 1200; ++i) {
    // Arrivals are exponential; the runs that end early lie far below all of them.
    const bool arrives = i % 4 != 0;
    records.push_back({i,
                       arrives ? TrialOutcome::kGoalReached : TrialOutcome::kNoPath,
                       "",
                       {arrives ? 7.0 + core::SampleExponential(stream, 1.0) : stream.Uniform()}});
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  const ComparedValue row = CompareOne(Value(StatisticKind::kExponentialTail, 40, none), records);
  EXPECT_LT(row.p_value, 0.1);
  ASSERT_EQ(row.beside.size(), 1u);
  EXPECT_NEAR(row.beside[0].p_value, 0.95, 0.03);
}

TEST(ByArrival, NothingWhereTheSimulationHasNoSuchRuns) {
  std::vector<Record> records = Uniforms(2.0, 300);
  for (Record& record : records) record.outcome = TrialOutcome::kGoalReached;
  EXPECT_TRUE(CompareOne(Value(StatisticKind::kMaximum, 39, 1.0), records).beside.empty());
  EXPECT_EQ(CompareOne(Value(StatisticKind::kMaximum, 40, 1.0), records).beside.size(), 1u);
  EXPECT_TRUE(CompareOne(Value(StatisticKind::kNegativeCount, 39, 1.0), records).beside.empty());
}

// A ratio and a mean show what they are over the arrivals alone, with an interval of their own.
TEST(ByArrival, RatiosAndMeansOfArrivalsAlone) {
  std::vector<Record> records;
  core::RandomStream stream({5, 1}, core::Purpose::kTest);
  for (std::uint32_t i = 0; i < 400; ++i) {
    const bool arrives = i % 2 == 0;
    const double base = 1.0 + stream.Uniform();
    const double x = base * (arrives ? 1.0 : 6.0) + core::SampleNormal(stream, 0.0, 0.1);
    records.push_back(
        {i, arrives ? TrialOutcome::kGoalReached : TrialOutcome::kNoPath, "", {x, base}});
  }
  PublishedValue value = Value(StatisticKind::kRatio, 0, 1.0);
  value.sample_size = 0;
  value.of = "base";
  value.low = 0.5;
  value.high = 2.0;
  value.factor = 10.0;
  const ComparedValue ratio = CompareOne(value, records);
  EXPECT_NEAR(ratio.pool_value, 35.0, 1.0);
  ASSERT_EQ(ratio.beside.size(), 1u);
  EXPECT_EQ(ratio.beside[0].name, "arrivals alone");
  EXPECT_NEAR(ratio.beside[0].median, 10.0, 0.2);
  // 1.96 times .1 over 1.5 times the root of 200, times 10.
  EXPECT_NEAR(ratio.beside[0].interval.high - ratio.beside[0].interval.low, 0.185, 0.03);
  value.statistic = StatisticKind::kMean;
  value.of.clear();
  EXPECT_NEAR(CompareOne(value, records).beside.at(0).median, 15.0, 0.5);
  for (Record& record : records) record.outcome = TrialOutcome::kGoalReached;
  EXPECT_TRUE(CompareOne(value, records).beside.empty());
}

// Absolute values of a normal law, in a unit of choice.
std::vector<Record> AbsoluteErrors(double unit = 1.0) {
  std::vector<Record> records;
  core::RandomStream stream({6, 1}, core::Purpose::kTest);
  for (std::uint32_t i = 0; i < 300; ++i) {
    const double x = std::abs(core::SampleNormal(stream, 0.0, 1.0)) / unit;
    records.push_back({i, TrialOutcome::kGoalReached, "", {x}});
  }
  return records;
}

double PowerWith(StatisticKind statistic, double limit, double unit = 1.0) {
  PublishedValue value = Value(statistic, 0, 1.0);
  value.lower_limit = limit;
  return CompareOne(value, AbsoluteErrors(unit)).power;
}

// Forty errors say next to nothing about a scale by their minimum, while a shift by half a
// deviation, fifteen times the minimum, is certain to be seen.
TEST(PowerWithALimit, AMinimumOfAbsoluteErrorsIsUnderpowered) {
  const double nowhere = -std::numeric_limits<double>::infinity();
  EXPECT_LT(PowerWith(StatisticKind::kMinimum, 0.0), 0.3);
  EXPECT_GT(PowerWith(StatisticKind::kMinimum, nowhere), 0.99) << "control: by a shift alone";
}

TEST(PowerWithALimit, IsNeverAboveThatOfAShift) {
  const double nowhere = -std::numeric_limits<double>::infinity();
  using enum StatisticKind;
  for (const StatisticKind statistic : {kMinimum, kMaximum}) {
    EXPECT_LE(PowerWith(statistic, 0.0), PowerWith(statistic, nowhere));
  }
  EXPECT_EQ(PowerWith(kMaximum, 0.0), PowerWith(kMaximum, nowhere)) << "a shift is harder to see";
}

TEST(PowerWithALimit, DoesNotDependOnTheUnit) {
  EXPECT_EQ(PowerWith(StatisticKind::kMinimum, 0.0, 0.0078125),
            PowerWith(StatisticKind::kMinimum, 0.0));
}

// A statistic that is uniform from .9 to 1.1: times 1.15 it lies above 1.1 in 72 % of cases,
// divided by 1.15 below .9 in 67 %.
TEST(PowerWithALimit, TheDirectionThatIsHarderToSeeCounts) {
  std::vector<double> even;
  for (int i = 0; i <= 2000; ++i) even.push_back(0.9 + 0.0001 * i);
  EXPECT_NEAR(ScalePower(even, 0.0, 1.15, 0.002), (0.9 - 0.9 / 1.15) / (0.2 / 1.15), 0.005);
  EXPECT_EQ(ScalePower(even, 0.0, 1.15, 0.002), ScalePower(even, 0.0, 1.0 / 1.15, 0.002));
}

double MeanOf(std::span<const double> sample) { return MomentsOf(sample).mean(); }

TEST(PowerWithALimit, ScalesAboutTheLimit) {
  std::vector<double> pool;
  for (const Record& record : AbsoluteErrors()) pool.push_back(10.0 + record.values[0]);
  const PredictiveSampler sampler(pool, 10.0);
  auto means = PredictiveStatistics(sampler, 40, MeanOf, 2000, {.seed = 1, .trial = 0});
  std::sort(means.begin(), means.end());
  EXPECT_LT(ScalePower(means, 10.0, 1.0, 0.05), 0.07);
  // A mean of .8 with a standard error of .1: twice as much is sure to be seen, a tenth more is
  // not; taken about 0, a tenth more is ten errors.
  EXPECT_GT(ScalePower(means, 10.0, 2.0, 0.05), 0.95);
  EXPECT_LT(ScalePower(means, 10.0, 1.1, 0.05), 0.3);
  EXPECT_GT(ScalePower(means, 0.0, 1.1, 0.05), 0.95);
}

}  // namespace
}  // namespace rockyard::statistics
