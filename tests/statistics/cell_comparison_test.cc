#include <gtest/gtest.h>

#include <string_view>
#include <vector>

#include "statistics/cell_summary.h"
#include "truth/measured_schema.h"

namespace rockyard::statistics {
namespace {

using truth::Record;
using truth::TrialOutcome;

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
