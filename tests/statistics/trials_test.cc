// Summaries and incidence curves of trial records.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"
#include "statistics/cumulative_incidence.h"
#include "statistics/drive_summary.h"
#include "synthetic_trials.h"

namespace rockyard::statistics {
namespace {

using truth::TrialOutcome;

truth::Record MakeRecord(TrialOutcome outcome, std::vector<double> values) {
  truth::Record record;
  record.outcome = outcome;
  record.values = std::move(values);
  return record;
}

const truth::RecordSchema kSchema = {{"true_distance_m", "m", ""}, {"displacement_m", "m", ""}};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(DriveSummary, HandWorked) {
  const std::vector<truth::Record> records = {MakeRecord(TrialOutcome::kGoalReached, {8.0, 4.0}),
                                              MakeRecord(TrialOutcome::kFalseGoal, {6.0, 4.0}),
                                              MakeRecord(TrialOutcome::kJammed, {1.0, 4.0}),
                                              MakeRecord(TrialOutcome::kSimulatorFault, {}),
                                              MakeRecord(TrialOutcome::kNoPath, {kNaN, 4.0})};
  const DriveSummary summary = Summarize(kSchema, records, 10);
  EXPECT_EQ(summary.planned, 10);
  EXPECT_EQ(summary.completed, 5);
  EXPECT_EQ(summary.faults, 1);
  EXPECT_EQ(summary.declared_success.count, 2);
  EXPECT_EQ(summary.declared_success.trials, 4);
  EXPECT_EQ(summary.true_success.count, 1);
  EXPECT_EQ(summary.outcome(TrialOutcome::kJammed), 1);
  const ColumnSummary* distance = summary.Find("true_distance_m");
  ASSERT_NE(distance, nullptr);
  EXPECT_EQ(distance->count, 3);
  EXPECT_EQ(distance->min, 1.0);
  EXPECT_EQ(distance->median, 6.0);
  EXPECT_EQ(distance->mean, 5.0);
  EXPECT_EQ(distance->mode, 7.0);
  EXPECT_EQ(distance->max, 8.0);
  EXPECT_NEAR(distance->std, std::sqrt(13.0), 1e-12);
  const ColumnSummary* ratio = summary.Find("path_ratio");
  ASSERT_NE(ratio, nullptr);
  EXPECT_EQ(ratio->count, 2);
  EXPECT_EQ(ratio->max, 2.0);
  EXPECT_EQ(summary.Find("absent"), nullptr);
}

TEST(DriveSummary, NothingAndNothingButFaults) {
  for (const std::vector<truth::Record>& records :
       {std::vector<truth::Record>{},
        std::vector<truth::Record>{MakeRecord(TrialOutcome::kSimulatorFault, {})}}) {
    const DriveSummary summary = Summarize(kSchema, records);
    EXPECT_TRUE(std::isnan(summary.declared_success.rate));
    EXPECT_EQ(summary.declared_success.interval.high, 1.0);
    ASSERT_NE(summary.Find("true_distance_m"), nullptr);
    EXPECT_TRUE(std::isnan(summary.Find("true_distance_m")->median));
  }
}

TEST(CumulativeIncidence, HandWorkedWithCensoring) {
  // At 1: goal, 4 at risk -> 1/4. At 2: censored. At 3: failure, 2 at risk -> 3/4 * 1/2.
  // At 4: goal, 1 at risk -> 1/4 + 3/8.
  const std::vector<Duration> durations = {{1.0, EndKind::kEvent},
                                           {2.0, EndKind::kCensored},
                                           {3.0, EndKind::kCompeting},
                                           {4.0, EndKind::kEvent}};
  const auto steps = CumulativeIncidence(durations);
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_DOUBLE_EQ(steps[0].event, 0.25);
  EXPECT_DOUBLE_EQ(steps[1].event, 0.25);
  EXPECT_DOUBLE_EQ(steps[1].competing, 0.375);
  EXPECT_EQ(steps[1].at_risk, 2);
  EXPECT_DOUBLE_EQ(steps[2].event, 0.625);
  EXPECT_TRUE(CumulativeIncidence({}).empty());
}

// 0 of n and n of n have no variance, and are no certainty either: the ends are those of
// Clopper-Pearson, 1 - 0.025^(1/n) and 0.025^(1/n).
TEST(CumulativeIncidence, BandWhereNoneOrAllArrived) {
  std::vector<Duration> durations(20, {1.0, EndKind::kCompeting});
  EXPECT_DOUBLE_EQ(CumulativeIncidence(durations).back().band.low, 0.0);
  EXPECT_NEAR(CumulativeIncidence(durations).back().band.high, 1.0 - std::pow(0.025, 1.0 / 20.0),
              1e-12);
  for (std::size_t i = 0; i < durations.size(); ++i) {
    durations[i] = {1.0 + static_cast<double>(i), EndKind::kEvent};
  }
  const auto all = CumulativeIncidence(durations);
  EXPECT_NEAR(all.back().band.low, std::pow(0.025, 1.0 / 20.0), 1e-12);
  EXPECT_DOUBLE_EQ(all.back().band.high, 1.0);
  // Who was censored before says nothing of the rest.
  durations[0].kind = EndKind::kCensored;
  EXPECT_NEAR(CumulativeIncidence(durations).back().band.low, std::pow(0.025, 1.0 / 19.0), 1e-12);
}

TEST(CumulativeIncidence, WithoutCensoringItIsTheBinomialProportion) {
  const auto records = SyntheticTrials({.success_rate = 0.8}, 11, 200);
  const auto steps = CumulativeIncidence(GoalDurations(records, 0));
  double reached = 0.0;
  for (const truth::Record& r : records) reached += truth::DeclaredSuccess(r.outcome) ? 1.0 : 0.0;
  const double rate = reached / 200.0;
  EXPECT_NEAR(steps.back().event, rate, 1e-12);
  EXPECT_NEAR(steps.back().event + steps.back().competing, 1.0, 1e-12);
  const IncidenceStep& middle = steps[100];
  EXPECT_NEAR(middle.standard_error, std::sqrt(middle.event * (1.0 - middle.event) / 200.0),
              0.03 * middle.standard_error);
}

// Coverage of the band at one distance, half of the trials censored at random distances.
TEST(CumulativeIncidence, BandCoversTheTruthUnderCensoringAndNaiveCountingDoesNot) {
  constexpr int kSets = 400;
  constexpr double kAt = 1.0;
  // Rates 1 (goal) and 0.25 (failure) per metre: F(1) = 0.8 (1 - exp(-1.25)).
  const double truth = 0.8 * (1.0 - std::exp(-1.25 * kAt));
  int covered = 0;
  int naive_covered = 0;
  for (std::uint32_t set = 0; set < kSets; ++set) {
    std::vector<Duration> durations;
    std::int64_t reached = 0;
    for (std::uint32_t i = 0; i < 100; ++i) {
      core::RandomStream stream({.seed = 21, .trial = set}, core::Purpose::kTest, i);
      const double end = core::SampleExponential(stream, 1.0 / 1.25);
      const bool goal = core::SampleBernoulli(stream, 0.8);
      const double stop = core::SampleExponential(stream, 0.8);
      const EndKind kind = goal ? EndKind::kEvent : EndKind::kCompeting;
      durations.push_back(stop < end ? Duration{stop, EndKind::kCensored} : Duration{end, kind});
      if (durations.back().kind == EndKind::kEvent && durations.back().at <= kAt) ++reached;
    }
    IncidenceStep last;
    for (const IncidenceStep& step : CumulativeIncidence(durations)) {
      if (step.at <= kAt) last = step;
    }
    covered += last.band.low <= truth && truth <= last.band.high ? 1 : 0;
    const Interval naive = ProportionInterval(reached, 100);
    naive_covered += naive.low <= truth && truth <= naive.high ? 1 : 0;
  }
  EXPECT_NEAR(covered / static_cast<double>(kSets), 0.95, 0.03);
  EXPECT_LT(naive_covered / static_cast<double>(kSets), 0.5);
}

// A time limit ends who has not arrived: left out of those at risk, it would lift the curve above
// the success rate.
TEST(CumulativeIncidence, EndsAtTheSuccessRateWhereTimeLimitsEndTrials) {
  std::vector<truth::Record> records = SyntheticTrials({.success_rate = 0.8}, 12, 150);
  for (std::size_t i = 0; i < records.size(); i += 4) records[i].outcome = TrialOutcome::kTimeLimit;
  const DriveSummary summary = Summarize(SyntheticSchema(), records);
  std::vector<Duration> durations = GoalDurations(records, 0);
  const IncidenceStep end = CumulativeIncidence(durations).back();
  EXPECT_EQ(end.event, summary.declared_success.rate);
  EXPECT_EQ(end.event + end.competing, 1.0);
  const Interval exact = ProportionInterval(summary.declared_success.count, 150, kConfidence,
                                            IntervalMethod::kClopperPearson);
  EXPECT_EQ(end.band.low, exact.low);
  EXPECT_EQ(end.band.high, exact.high);
  EXPECT_NEAR(end.standard_error, std::sqrt(end.event * end.competing / 150.0), 1e-12);
  for (std::size_t i = 0; i < records.size(); i += 4) durations[i].kind = EndKind::kCensored;
  EXPECT_GT(CumulativeIncidence(durations).back().event, end.event + 0.1);
}

TEST(GoalDurations, WhatDoesNotArriveCompetes) {
  const std::vector<truth::Record> records = {
      MakeRecord(TrialOutcome::kGoalReached, {8.0}), MakeRecord(TrialOutcome::kFalseGoal, {7.0}),
      MakeRecord(TrialOutcome::kTimeLimit, {30.0}), MakeRecord(TrialOutcome::kJammed, {2.0}),
      MakeRecord(TrialOutcome::kSimulatorFault, {})};
  const auto declared = GoalDurations(records, 0);
  ASSERT_EQ(declared.size(), 4u);
  EXPECT_EQ(declared[1].kind, EndKind::kEvent);
  EXPECT_EQ(declared[2].kind, EndKind::kCompeting);
  EXPECT_EQ(declared[3].kind, EndKind::kCompeting);
  EXPECT_EQ(GoalDurations(records, 0, Success::kTrue)[1].kind, EndKind::kCompeting);
}

}  // namespace
}  // namespace rockyard::statistics
