#include "statistics/cell_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

namespace rockyard::statistics {
namespace {

using truth::Record;
using truth::TrialOutcome;

truth::RecordSchema Schema() {
  constexpr std::string_view kNames[] = {"cell", "height_m", "scenes", "scans", "detected_single"};
  return truth::MeasurementSchema(kNames);
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

TEST(CellSummary, IntervalsAreWilsonsAtTheLevelOfOneAndOfAllCells) {
  const MeasurementSummary summary = SummarizeCells(Schema(), Records());
  const CellRate& rate = summary.cells[0].rates[0];
  EXPECT_EQ(rate.rate.interval.low, ProportionInterval(60, 400, 0.95).low);
  EXPECT_EQ(rate.simultaneous.high, ProportionInterval(60, 400, 0.975).high);
  EXPECT_LT(rate.simultaneous.low, rate.rate.interval.low);
  const Interval widest = ProportionInterval(60, 400, 0.95);
  EXPECT_DOUBLE_EQ(summary.WidestInterval(0), widest.high - widest.low);
  EXPECT_EQ(summary.FindRate("detected_single"), 0u);
  EXPECT_EQ(summary.FindRate("missed"), summary.rates.size());
}

TEST(CellSummary, SquaresBecomeARootMeanSquareAndNoBaseNoMean) {
  constexpr std::string_view kNames[] = {"cell", "points", "found", "range_error_m"};
  const std::vector<Record> records{{0, TrialOutcome::kMeasured, "", {0, 9, 4, 16.0}},
                                    {1, TrialOutcome::kMeasured, "", {1, 9, 0, 0.0}}};
  const MeasurementSummary summary = SummarizeCells(truth::MeasurementSchema(kNames), records);
  EXPECT_DOUBLE_EQ(summary.cells[0].means[0], 2.0);
  EXPECT_TRUE(std::isnan(summary.cells[1].means[0]));
}

TEST(CellSummary, EveryBaseIsAColumn) {
  for (const truth::MeasuredColumn& column : truth::kMeasuredColumns) {
    if (column.of.empty()) {
      EXPECT_TRUE(column.role == truth::ColumnRole::kFactor ||
                  column.role == truth::ColumnRole::kBase)
          << column.name;
    } else {
      EXPECT_NE(truth::FindMeasuredColumn(column.of), nullptr) << column.name;
    }
  }
}

}  // namespace
}  // namespace rockyard::statistics
