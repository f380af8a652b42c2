// Two measurements against each other, in words and as a table.
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "core/says.h"
#include "report/cell_comparison_text.h"
#include "truth/measured_schema.h"

namespace rockyard::report {
namespace {

using statistics::CellComparison;
using testing::HasSubstr;
using testing::Not;

// `cells` heights; in the last one `last` of 200 are seen, 100 elsewhere. Believed: 90 everywhere.
struct SeenRun {
  SeenRun(int cells, double last) {
    for (int cell = 0; cell < cells; ++cell) {
      const double seen = cell + 1 == cells ? last : 100.0;
      records.push_back({records.size(),
                         truth::TrialOutcome::kMeasured,
                         "",
                         {static_cast<double>(cell), 0.01 * cell, 200.0, seen, 90.0}});
    }
  }
  statistics::MeasurementSummary Summary() const {
    return statistics::SummarizeCells(schema, records);
  }
  ComparedRun View(const char* name) const { return {name, 1, schema, records}; }

  static constexpr std::string_view kNames[] = {"height_m", "scenes", "detected_single",
                                                "detected_double"};
  truth::RecordSchema schema = truth::MeasuredSchema(kNames);
  std::vector<truth::Record> records;
};

std::string Text(const SeenRun& a, const SeenRun& b) {
  return CellComparisonText(a.View("geometric"), b.View("image"),
                            statistics::CompareCells(a.Summary(), b.Summary()));
}

TEST(CellComparisonText, SaysThatNothingDiffers) {
  const std::string text = Text(SeenRun(6, 100), SeenRun(4, 104));
  EXPECT_THAT(text, core::Says("A: geometric, seed 1, 6 runs",
                               "4 cells in both, 2 only in A; none differs at alpha 0.05",
                               "8 tests", "detected_double, every cell"));
  EXPECT_THAT(text, Not(HasSubstr("cells that differ")));
}

TEST(CellComparisonText, NamesWhatDiffers) {
  const std::string text = Text(SeenRun(4, 100), SeenRun(4, 160));
  EXPECT_THAT(text, core::Says("4 cells in both; 1 of them differs",
                               "detected_single, the cells that differ", "0.5000 0.8000 +0.3000"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '*'), 1);
}

TEST(CellComparisonText, ManyCellsAreCutAndEveryLineFits) {
  const std::string text = Text(SeenRun(60, 0), SeenRun(60, 200));
  EXPECT_THAT(text, HasSubstr("the 40 of smallest p"));
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_LT(count, 60);
}

TEST(CellComparisonCsv, HasALineForEachRateOfEachCell) {
  const CellComparison comparison =
      statistics::CompareCells(SeenRun(5, 100).Summary(), SeenRun(5, 200).Summary());
  std::istringstream lines(CellComparisonCsv(comparison));
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, testing::StartsWith("rate,height_m,a_count,a_trials,a_rate,b_count"));
  const auto commas = std::count(line.begin(), line.end(), ',');
  int count = 0;
  int differing = 0;
  for (; std::getline(lines, line); ++count) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
    differing += line.back() == '1' ? 1 : 0;
  }
  EXPECT_EQ(count, 10);
  EXPECT_EQ(differing, 1);
}

}  // namespace
}  // namespace rockyard::report
