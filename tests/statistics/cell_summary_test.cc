#include "statistics/cell_summary.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "truth/measured_schema.h"

namespace rockyard::statistics {
namespace {

using truth::Record;
using truth::TrialOutcome;

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

}  // namespace
}  // namespace rockyard::statistics
