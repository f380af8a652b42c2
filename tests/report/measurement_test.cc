// Reports of experiments that measure; two measurements, cell by cell, in words and as a table.
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "core/count_of.h"
#include "core/says.h"
#include "report/paired_comparison.h"
#include "report/sample_run.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "statistics/cell_summary.h"
#include "truth/measured_schema.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using statistics::CellComparison;
using statistics::IntervalMethod;
using statistics::MeasurementSummary;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using truth::TrialOutcome;

// Heights by diameters, `runs` runs each; the rate grows with the cell.
MeasurementSummary Sample(int heights, int diameters) {
  constexpr std::string_view kNames[] = {"height_m", "diameter_m",      "scenes",
                                         "scans",    "detected_single", "detected_double"};
  std::vector<truth::Record> records;
  for (int h = 0; h < heights; ++h) {
    for (int d = 0; d < diameters; ++d) {
      const double cell = h * diameters + d;
      records.push_back({records.size(),
                         TrialOutcome::kMeasured,
                         "",
                         {cell, 0.05 * h, 0.1 * d, 100.0, 120.0, 5.0 * h, 4.0 * h}});
    }
  }
  return statistics::SummarizeCells(truth::MeasuredSchema(kNames), records, 100);
}

TEST(MeasurementReport, NothingSpeaksOfSuccess) {
  const MeasurementSummary summary = Sample(3, 2);
  const RunDescription run = SampleDescription();
  EXPECT_THAT(MeasurementText(run, summary), Not(HasSubstr("success")));
  EXPECT_THAT(MeasurementJson(run, summary), Not(HasSubstr("success")));
}

TEST(MeasurementReport, JsonHoldsEveryCell) {
  const MeasurementSummary summary = Sample(3, 2);
  const json parsed = json::parse(MeasurementJson(SampleDescription(), summary));
  ASSERT_EQ(parsed["cells"].size(), 6u);
  const json& cell = parsed["cells"][5];
  EXPECT_EQ(cell["height_m"], 0.1);
  EXPECT_EQ(cell["scenes"], 100.0);
  EXPECT_EQ(cell["detected_double"]["count"], 8);
  EXPECT_EQ(cell["mean_scans"], 1.2);
  const json& rate = cell["detected_double"];
  EXPECT_LT(rate["ci95_all_cells"][0], rate["ci95"][0]);
  EXPECT_EQ(parsed["widest_ci95"]["detected_double"], summary.WidestInterval(1));
}

TEST(MeasurementReport, CsvHasALineACellAndAsManyFieldsAsItsHeader) {
  std::istringstream lines(CellsCsv(Sample(3, 2)));
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, HasSubstr("cell,runs,height_m,diameter_m,scenes,detected_single,"));
  EXPECT_THAT(line, HasSubstr("detected_double_all_high,mean_scans"));
  const auto fields = std::count(line.begin(), line.end(), ',');
  int cells = 0;
  while (std::getline(lines, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), fields);
    ++cells;
  }
  EXPECT_EQ(cells, 6);
}

TEST(MeasurementReport, OneCellIsToldWhole) {
  constexpr std::string_view kNames[] = {"height_m", "scenes",          "hazards",
                                         "scans",    "detected_single", "detected_double"};
  const std::vector<truth::Record> records = {
      {0, TrialOutcome::kMeasured, "", {0.0, 0.2, 100.0, 7.0, 120.0, 5.0, 0.0}}};
  const MeasurementSummary summary =
      statistics::SummarizeCells(truth::MeasuredSchema(kNames), records, 1);
  const std::string text = MeasurementText(SampleDescription(), summary);
  EXPECT_THAT(text, HasSubstr("  height_m 0.2\n"
                              "  hazards 7\n"
                              "  of 100 scenes, with 95 % intervals\n"
                              "    detected_single   5.0 %  2.2 .. 11.2\n"
                              "    never (up to 3.6 %): detected_double\n"
                              "  means\n"
                              "    scans                1.2  of scenes\n"));
  EXPECT_THAT(text, Not(AnyOf(HasSubstr("1 cells"), HasSubstr("widest"), HasSubstr("cells.csv"))));
}

TEST(MeasurementReport, FewCellsAreListedManyArePooled) {
  EXPECT_THAT(MeasurementText(SampleDescription(), Sample(3, 2)), HasSubstr("A height_m"));
  const std::string pooled = MeasurementText(SampleDescription(), Sample(20, 3));
  EXPECT_THAT(pooled, HasSubstr("detected_double by height_m (down) and diameter_m (across)"));
  std::istringstream lines(pooled);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(MeasurementReport, TheDrawingHasAPanelAndACurveForEachDiameter) {
  const std::string svg = CellsSvg(Sample(4, 3), "a < b > \"c\"");
  EXPECT_THAT(svg, HasSubstr("a &lt; b &gt; &quot;c&quot;"));
  EXPECT_EQ(core::CountOf(svg, "<polyline"), 3);
  EXPECT_EQ(CellsSvg(Sample(1, 3), "one height"), "") << "nothing to draw against";
}

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
