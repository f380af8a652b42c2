// Drives whose navigator ended the process that ran them: they have an outcome and no value.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics/clustered_rate.h"
#include "statistics/cumulative_incidence.h"
#include "statistics/drive_summary.h"
#include "statistics/published_comparison.h"
#include "synthetic_trials.h"
#include "truth/end_cause.h"

namespace rockyard::statistics {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using truth::Record;
using truth::TrialOutcome;

constexpr auto kCrash = truth::EndCause::kNavigatorCrashed;

Record Crash(std::uint64_t trial, const truth::RecordSchema& schema) {
  return truth::MakeNavigatorCrash(trial, std::string(truth::Info(kCrash).sentence), schema.size());
}

// Every fifth of 40 trials.
std::vector<Record> WithCrashes() {
  std::vector<Record> records = SyntheticTrials({.success_rate = 0.7}, 31, 40);
  for (std::size_t i = 0; i < records.size(); i += 5) records[i] = Crash(i, SyntheticSchema());
  return records;
}

// The same without these trials, which leaves 32.
std::vector<Record> Others() {
  std::vector<Record> records = WithCrashes();
  std::erase_if(records, truth::IsNavigatorCrash);
  return records;
}

TEST(NavigatorCrash, IsToldByItsRecord) {
  const truth::RecordSchema schema = SyntheticSchema();
  EXPECT_TRUE(truth::IsNavigatorCrash(Crash(3, schema)));
  EXPECT_FALSE(truth::IsFault(Crash(3, schema)));
  EXPECT_EQ(truth::CauseOf(Crash(3, schema)), kCrash);
  // The control: a navigator that reported an error leaves what was measured up to then; a fault of
  // the simulator has no values either.
  Record reported = Crash(3, schema);
  reported.values[0] = 2.0;
  EXPECT_FALSE(truth::IsNavigatorCrash(reported));
  EXPECT_FALSE(truth::IsNavigatorCrash(truth::MakeFault(1, 3, "blew up")));
}

TEST(NavigatorCrash, CountsInRatesAndNowhereElse) {
  const DriveSummary with = Summarize(SyntheticSchema(), WithCrashes());
  const DriveSummary without = Summarize(SyntheticSchema(), Others());
  EXPECT_EQ(with.faults, 0);
  EXPECT_EQ(with.declared_success.trials, 40);
  EXPECT_EQ(with.declared_success.count, without.declared_success.count);
  EXPECT_EQ(with.outcome(TrialOutcome::kNavigatorFault), 8);
  EXPECT_EQ(with.cause(kCrash), 8);
  EXPECT_EQ(with.ended_by_limit.count, 0);
  for (std::size_t i = 0; i < with.columns.size(); ++i) {
    EXPECT_EQ(with.columns[i].count, without.columns[i].count) << with.columns[i].name;
    // NaN where no drive arrived, as of both.
    EXPECT_FALSE(with.columns[i].mean < without.columns[i].mean) << with.columns[i].name;
    EXPECT_FALSE(with.columns[i].mean > without.columns[i].mean) << with.columns[i].name;
  }
  ASSERT_EQ(with.metrics.size(), without.metrics.size());
  for (std::size_t i = 0; i < with.metrics.size(); ++i) {
    const MetricSummary& metric = with.metrics[i];
    const bool of_outcomes = metric.metric.source == MetricSource::kOutcome ||
                             metric.metric.source == MetricSource::kCause;
    EXPECT_EQ(metric.count, of_outcomes ? 40 : without.metrics[i].count) << metric.metric.name;
  }
  // Nothing but such trials: rates of outcomes, and no number else.
  const auto& alone =
      with.metrics_by_outcome[static_cast<std::size_t>(TrialOutcome::kNavigatorFault)];
  ASSERT_FALSE(alone.empty());
  for (const MetricSummary& metric : alone) EXPECT_EQ(metric.count, 0) << metric.metric.name;
}

// The control: a fault of the simulator in its place is in no rate.
TEST(NavigatorCrash, IsNoFaultOfTheSimulator) {
  std::vector<Record> records = WithCrashes();
  for (Record& record : records) {
    if (truth::IsNavigatorCrash(record)) record = truth::MakeFault(1, record.trial, "blew up");
  }
  EXPECT_EQ(Summarize(SyntheticSchema(), records).declared_success.trials, 32);
}

TEST(NavigatorCrash, LeavesTheIncidenceOfArrivalAtTheSuccessRate) {
  const std::vector<Record> records = WithCrashes();
  const DriveSummary summary = Summarize(SyntheticSchema(), records);
  const auto durations = GoalDurations(records, 0);
  const auto steps = CumulativeIncidence(durations);
  EXPECT_EQ(steps.back().event, summary.declared_success.rate);
  EXPECT_TRUE(std::isinf(steps.back().at));
  EXPECT_EQ(steps.back().at_risk, 8);
  EXPECT_EQ(steps.front().at_risk, 40);
  // Before that step it is the same number: where such a drive ended changes no share of arrivals.
  const IncidenceStep& known = steps[steps.size() - 2];
  EXPECT_EQ(known.event, summary.declared_success.rate);
  EXPECT_DOUBLE_EQ(known.event + known.competing, 32.0 / 40.0);
  // The control: left out, they would lift the curve above the rate.
  EXPECT_GT(CumulativeIncidence(GoalDurations(Others(), 0)).back().event,
            summary.declared_success.rate + 0.05);
}

TEST(NavigatorCrash, WhoArrivedAtAnUnknownDistanceIsLeftOut) {
  const std::vector<Record> records = {
      {0, TrialOutcome::kGoalReached, "", {std::numeric_limits<double>::quiet_NaN()}},
      {1, TrialOutcome::kJammed, "", {2.0}}};
  ASSERT_EQ(CumulativeIncidence(GoalDurations(records, 0)).size(), 1u);
}

const truth::RecordSchema kLayouts{{"layout", "1", ""}};

// Trials of layouts of n each, without those that are named.
std::vector<Record> OnLayoutsOf(std::uint64_t n, std::uint64_t trials,
                                std::initializer_list<std::uint64_t> crashed) {
  std::vector<Record> records;
  for (std::uint64_t trial = 0; trial < trials; ++trial) {
    const auto layout = static_cast<double>(trial / n);
    records.push_back({trial, TrialOutcome::kGoalReached, "", {layout}});
    if (std::ranges::find(crashed, trial) != crashed.end()) records.back() = Crash(trial, kLayouts);
  }
  return records;
}

TEST(NavigatorCrash, HangsTogetherWithTheTrialsOfItsLayout) {
  const auto groups = [](const std::vector<Record>& records) {
    return DependentGroups(kLayouts, records);
  };
  EXPECT_THAT(groups(OnLayoutsOf(2, 6, {2})), ElementsAre(0, 0, 1, 1, 2, 2));
  EXPECT_THAT(groups(OnLayoutsOf(3, 7, {2, 3})), ElementsAre(0, 0, 0, 1, 1, 1, 2));
  EXPECT_THAT(groups(OnLayoutsOf(3, 6, {0, 5})), ElementsAre(0, 0, 0, 1, 1, 1));
  // Where each trial has a layout of its own, so has this one; the control of all above.
  EXPECT_THAT(groups(OnLayoutsOf(1, 5, {0, 3})), IsEmpty());
  EXPECT_THAT(groups(OnLayoutsOf(1, 2, {0, 1})), IsEmpty());
  // A fault is in no rate and needs no layout.
  std::vector<Record> faulted = OnLayoutsOf(2, 4, {});
  faulted[1] = truth::MakeFault(1, 1, "blew up");
  EXPECT_THAT(groups(faulted), ElementsAre(0, 1, 2, 2));
}

PublishedValue Value(StatisticKind kind, std::string column) {
  PublishedValue value;
  value.id = "id";
  value.scenario = "s";
  value.statistic = kind;
  value.column = std::move(column);
  value.low = 0.0;
  value.high = 100.0;
  value.sample_size = 10;
  value.value = 7.0;
  value.outcomes = {TrialOutcome::kGoalReached, TrialOutcome::kFalseGoal};
  return value;
}

ComparedValue Compared(PublishedValue value, const std::vector<Record>& records) {
  PublishedReference reference;
  reference.values = {std::move(value)};
  const std::vector<ScenarioRun> runs = {RunOf("s", records)};
  return Compare(reference, runs, {.replicates = 200}).values.at(0);
}

TEST(NavigatorCrash, IsAFailureBesidePublishedValuesAndHasNoValueThere) {
  const std::vector<Record> with = WithCrashes();
  const std::vector<Record> without = Others();
  const ComparedValue rate = Compared(Value(StatisticKind::kOutcomeCount, ""), with);
  EXPECT_EQ(rate.pool, 40);
  EXPECT_EQ(Compared(Value(StatisticKind::kOutcomeCount, ""), without).pool, 32);
  for (const StatisticKind kind : {StatisticKind::kMean, StatisticKind::kRatio,
                                   StatisticKind::kMinimum, StatisticKind::kMaximum}) {
    PublishedValue value = Value(kind, "true_distance_m");
    if (kind == StatisticKind::kRatio) value.of = "straight_distance_m";
    const ComparedValue all = Compared(value, with);
    const ComparedValue known = Compared(value, without);
    EXPECT_TRUE(std::isfinite(all.pool_value));
    EXPECT_EQ(all.pool, known.pool);
    EXPECT_EQ(all.pool_value, known.pool_value);
    EXPECT_EQ(all.interval.low, known.interval.low);
    EXPECT_EQ(all.interval.high, known.interval.high);
  }
}

// Two trials on each layout: a crash counts as a failure on its own.
TEST(NavigatorCrash, IsOnItsLayoutBesidePublishedCounts) {
  truth::RecordSchema schema = SyntheticSchema();
  schema.push_back({"layout", "1", ""});
  std::vector<Record> records;
  for (std::uint32_t i = 0; i < 40; ++i) {
    records.push_back(SyntheticTrial({.success_rate = i % 4 < 2 ? 0.95 : 0.1}, 5, i));
    records.back().values.push_back(i / 2);
  }
  const auto p_value = [&](const std::vector<Record>& trials) {
    PublishedReference reference;
    reference.values = {Value(StatisticKind::kOutcomeCount, "")};
    const std::vector<ScenarioRun> runs = {{.scenario = "s", .schema = schema, .records = trials}};
    return Compare(reference, runs, {.replicates = 200}).values.at(0).one_layout->p_value;
  };
  std::vector<Record> crashed = records;
  std::vector<Record> jammed = records;
  for (const std::size_t trial : {0u, 4u, 9u, 12u, 33u}) {
    crashed[trial] = Crash(trial, schema);
    jammed[trial].outcome = TrialOutcome::kJammed;
  }
  EXPECT_EQ(p_value(crashed).low, p_value(jammed).low);
  EXPECT_NE(p_value(crashed).low, p_value(records).low) << "the control";
}

}  // namespace
}  // namespace rockyard::statistics
