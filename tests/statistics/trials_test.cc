// Summaries and incidence curves of trial records.

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <limits>

#include "core/random.h"
#include "statistics/cell_summary.h"
#include "statistics/cumulative_incidence.h"
#include "statistics/drive_summary.h"
#include "synthetic_trials.h"
#include "truth/measured_schema.h"

namespace rockyard::statistics {
namespace {

using truth::Record;
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
  EXPECT_NEAR(steps.back().event, reached / 200.0, 1e-12);
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

truth::RecordSchema Schema() {
  constexpr std::string_view kNames[] = {"height_m", "scenes", "scans", "detected_single"};
  return truth::MeasuredSchema(kNames);
}

// Two cells, the first with two runs; one fault.
std::vector<Record> Records() {
  return {{0, TrialOutcome::kMeasured, "", {0, 0.05, 100, 120, 20}},
          {1, TrialOutcome::kMeasured, "", {1, 0.10, 100, 150, 100}},
          {2, TrialOutcome::kMeasured, "", {0, 0.05, 300, 330, 40}},
          {3, TrialOutcome::kSimulatorFault, "blew up", {}}};
}

TEST(CellSummary, CountsAndBasesAddUpWithinACell) {
  const MeasurementSummary summary = SummarizeCells(Schema(), Records(), 8);
  EXPECT_EQ(summary.planned, 8);
  EXPECT_EQ(summary.completed, 4);
  EXPECT_EQ(summary.faults, 1);
  ASSERT_EQ(summary.cells.size(), 2u);
  const Cell& cell = summary.cells[0];
  EXPECT_EQ(cell.runs, 2);
  EXPECT_EQ(cell.factors, std::vector<double>{0.05});
  EXPECT_EQ(cell.bases, std::vector<double>{400.0});
  EXPECT_EQ(cell.rates[0].rate.count, 60);
  EXPECT_EQ(cell.rates[0].rate.trials, 400);
  EXPECT_DOUBLE_EQ(cell.means[0], 450.0 / 400.0);
}

TEST(CellSummary, IntervalsAreWilsonsForOneCellAndExactForAllAtOnce) {
  const MeasurementSummary summary = SummarizeCells(Schema(), Records());
  const CellRate& rate = summary.cells[0].rates[0];
  EXPECT_EQ(rate.rate.interval.low, ProportionInterval(60, 400, 0.95).low);
  EXPECT_EQ(rate.simultaneous.high,
            ProportionInterval(60, 400, 0.975, IntervalMethod::kClopperPearson).high);
  EXPECT_LT(rate.simultaneous.low, rate.rate.interval.low);
  const Interval widest = ProportionInterval(60, 400, 0.95);
  EXPECT_DOUBLE_EQ(summary.WidestInterval(0), widest.high - widest.low);
  EXPECT_EQ(summary.FindRate("detected_single"), 0u);
  EXPECT_EQ(summary.FindRate("missed"), summary.rates.size());
}

// 480 cells of 10000 scenes; cell k detects k times.
std::vector<Record> CountsUpTo(std::uint64_t cells) {
  std::vector<Record> records;
  for (std::uint64_t k = 0; k < cells; ++k) {
    const auto count = static_cast<double>(k);
    records.push_back({k, TrialOutcome::kMeasured, "", {count, 0.05, 10000, 10000, count}});
  }
  return records;
}

// Exact chance that the interval of a cell misses its rate p: the binomial probability of all
// counts (0 .. 479; more do not matter for small p) whose interval does not hold p.
template <typename IntervalOf>
double ChanceToMiss(double p, IntervalOf interval_of) {
  constexpr double kScenes = 10000.0;
  const boost::math::binomial law(kScenes, p);
  double missed = 0.0;
  for (std::size_t k = 0; k < 480; ++k) {
    const Interval interval = interval_of(k);
    const bool holds = interval.low <= p && p <= interval.high;
    if (!holds) missed += boost::math::pdf(law, static_cast<double>(k));
  }
  return missed;
}

TEST(CellSummary, SimultaneousIntervalsKeepTheirLevelNearZeroToo) {
  const MeasurementSummary summary = SummarizeCells(Schema(), CountsUpTo(480));
  const double level = 0.05 / 480;
  const auto all = [&](std::size_t k) { return summary.cells[k].rates[0].simultaneous; };
  const auto wilson = [&](std::size_t k) {
    return ProportionInterval(static_cast<std::int64_t>(k), 10000, 1.0 - level);
  };
  for (const double p : {1e-7, 1e-6, 5.8e-6, 1e-5, 5e-5, 1e-4, 1e-3, 5e-3, 1e-2}) {
    EXPECT_LE(ChanceToMiss(p, all), level) << p;
  }
  // Negative control: just below the lower end of one event, every event makes Wilson miss.
  EXPECT_GT(ChanceToMiss(5.8e-6, wilson), 0.05);
}

TEST(CellSummary, ARunThatJustBeganCorrectsForTheCellsToCome) {
  const std::vector<Record> four = CountsUpTo(4);
  const MeasurementSummary begun = SummarizeCells(Schema(), four, 480);
  EXPECT_EQ(begun.planned_cells, 480);
  EXPECT_EQ(begun.cells[3].rates[0].simultaneous.high,
            SummarizeCells(Schema(), CountsUpTo(480)).cells[3].rates[0].simultaneous.high);
  EXPECT_EQ(SummarizeCells(Schema(), four).planned_cells, 4) << "nothing more is planned";
  EXPECT_EQ(SummarizeCells(Schema(), Records(), 480).planned_cells, 2) << "cells come again";
}

TEST(CellSummary, SquaresBecomeARootMeanSquareAndNoBaseNoMean) {
  constexpr std::string_view kNames[] = {"points", "found", "range_error_m"};
  const std::vector<Record> records{{0, TrialOutcome::kMeasured, "", {0, 9, 4, 16.0}},
                                    {1, TrialOutcome::kMeasured, "", {1, 9, 0, 0.0}}};
  const MeasurementSummary summary = SummarizeCells(truth::MeasuredSchema(kNames), records);
  EXPECT_DOUBLE_EQ(summary.cells[0].means[0], 2.0);
  EXPECT_TRUE(std::isnan(summary.cells[1].means[0]));
}

TEST(CellSummary, AColumnWithoutARoleIsLeftOut) {
  constexpr std::string_view kNames[] = {"height_m", "scenes", "detected_single"};
  truth::RecordSchema schema = truth::MeasuredSchema(kNames);
  schema.push_back({"sim_time_s", "s", "of one trial"});
  const std::vector<Record> records{{0, TrialOutcome::kMeasured, "", {0, 0.1, 9, 4, 20.0}}};
  const MeasurementSummary summary = SummarizeCells(schema, records);
  EXPECT_EQ(summary.factors.size(), 1U);
  EXPECT_EQ(summary.bases.size(), 1U);
  EXPECT_EQ(summary.rates.size(), 1U);
  EXPECT_TRUE(summary.means.empty());
}

// One run of a cell.
struct Scenes {
  double cell;
  double height_m;
  double distance_m;
  double scenes;
  double single;
  double believed;
};

MeasurementSummary Summary(const std::vector<Scenes>& cells) {
  constexpr std::string_view kNames[] = {"height_m", "distance_m", "scenes", "detected_single",
                                         "detected_double"};
  std::vector<Record> records;
  for (const Scenes& c : cells) {
    records.push_back({records.size(),
                       TrialOutcome::kMeasured,
                       "",
                       {c.cell, c.height_m, c.distance_m, c.scenes, c.single, c.believed}});
  }
  return SummarizeCells(truth::MeasuredSchema(kNames), records);
}

TEST(CompareCells, MatchesByFactorsNotByNumber) {
  const MeasurementSummary large = Summary({{0, 0.05, 0.1, 80, 8, 0},
                                            {1, 0.05, 0.2, 80, 48, 40},
                                            {2, 0.10, 0.1, 80, 70, 70},
                                            {3, 0.10, 0.2, 80, 60, 60}});
  const MeasurementSummary small =
      Summary({{0, 0.10, 0.2, 70, 50, 50}, {1, 0.05, 0.2, 70, 56, 30}, {2, 0.15, 0.2, 70, 1, 1}});
  const CellComparison result = CompareCells(large, small);
  ASSERT_EQ(result.cells.size(), 2u);
  EXPECT_EQ(result.only_first, 2u);
  EXPECT_EQ(result.only_second, 1u);
  EXPECT_EQ(result.tests, 4u);
  EXPECT_EQ(result.cells[0].factors, (std::vector<double>{0.05, 0.2}));
  const RateDifference& rate = result.cells[0].rates[0];
  EXPECT_EQ(rate.first.count, 48);
  EXPECT_EQ(rate.second.count, 56);
  // Newcombe 1998, table II, contrast (a): 56/70 - 48/80.
  EXPECT_NEAR(rate.interval.low, 0.0524, 5e-5);
  EXPECT_NEAR(rate.interval.high, 0.3339, 5e-5);
  const Interval wide = DifferenceInterval(rate.first, rate.second, 1.0 - 0.05 / 4.0);
  EXPECT_DOUBLE_EQ(rate.simultaneous.low, wide.low);
  EXPECT_DOUBLE_EQ(rate.p_value, FisherExactPValue({48, 32, 56, 14}));
}

TEST(CompareCells, HolmIsOverAllRatesOfAllCells) {
  // p of 0/10 against 10/10: 2 / C(20, 10) = 2 / 184756. The other three tests are at p = 1.
  const CellComparison result =
      CompareCells(Summary({{0, 0.1, 0.1, 10, 0, 5}, {1, 0.2, 0.1, 10, 5, 5}}),
                   Summary({{0, 0.1, 0.1, 10, 10, 5}, {1, 0.2, 0.1, 10, 5, 5}}));
  const RateDifference& rate = result.cells[0].rates[0];
  EXPECT_NEAR(rate.p_value, 2.0 / 184756.0, 1e-12);
  EXPECT_NEAR(rate.adjusted, 4.0 * 2.0 / 184756.0, 1e-12);
  EXPECT_TRUE(result.Differs(rate));
  EXPECT_EQ(result.Differing(0), 1u);
  EXPECT_EQ(result.Differing(1), 0u);
  EXPECT_EQ(result.Differing(), 1u);
}

TEST(CompareCells, CellsWithoutTrialsAreNotTested) {
  const CellComparison result =
      CompareCells(Summary({{0, 0.1, 0.1, 0, 0, 0}, {1, 0.2, 0.1, 50, 25, 20}}),
                   Summary({{0, 0.1, 0.1, 50, 50, 50}, {1, 0.2, 0.1, 50, 25, 20}}));
  EXPECT_EQ(result.cells.size(), 2u);
  EXPECT_EQ(result.tests, 2u);
  EXPECT_FALSE(result.cells[0].rates[0].tested);
  EXPECT_EQ(result.Differing(), 0u);
}

TEST(CompareCells, OtherFactorsShareNothing) {
  constexpr std::string_view kNames[] = {"height_m", "diameter_m", "scenes", "detected_single"};
  const std::vector<Record> records{{0, TrialOutcome::kMeasured, "", {0, 0.1, 0.1, 10, 5}}};
  const MeasurementSummary other = SummarizeCells(truth::MeasuredSchema(kNames), records);
  const CellComparison result = CompareCells(Summary({{0, 0.1, 0.1, 10, 5, 5}}), other);
  EXPECT_TRUE(result.cells.empty());
  EXPECT_EQ(result.tests, 0u);
}

TEST(CompareCells, ARepeatedCellCountsOnce) {
  const MeasurementSummary twice = Summary({{0, 0.1, 0.1, 10, 5, 5}, {1, 0.1, 0.1, 10, 5, 5}});
  const CellComparison result = CompareCells(twice, Summary({{0, 0.1, 0.1, 10, 5, 5}}));
  EXPECT_EQ(result.cells.size(), 1u);
  EXPECT_EQ(result.only_first, 1u);
  EXPECT_EQ(result.only_second, 0u);
}

}  // namespace
}  // namespace rockyard::statistics
