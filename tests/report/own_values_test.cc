// What navigators count for themselves, in every file that tells of runs.

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/json_text.h"
#include "core/says.h"
#include "report/baseline.h"
#include "report/page_data.h"
#include "report/parameter_table.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "report/sweep_files.h"
#include "sample_run.h"
#include "sample_sweep.h"
#include "statistics/drive_summary.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using truth::Record;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr auto kWilson = statistics::IntervalMethod::kWilson;

// The sample run, whose navigator "mine" counted trial + 1 plans; "other" did not drive.
truth::RecordSchema OwnSchema() {
  truth::RecordSchema schema = SampleSchema();
  schema.push_back({"mine.replans", "1", "plans made anew"});
  schema.push_back({"other.looks", "1", "looks"});
  return schema;
}

std::vector<Record> OwnRecords() {
  std::vector<Record> records = SampleRecords();
  for (Record& record : records) {
    if (truth::IsFault(record)) continue;
    record.values.push_back(static_cast<double>(record.trial + 1));
    record.values.push_back(kNaN);
  }
  return records;
}

TEST(OwnValues, AreColumnsAndMetricsOfASummary) {
  const json with = json::parse(
      SummaryJson(SampleDescription(), statistics::Summarize(OwnSchema(), OwnRecords(), 8)));
  // Trials 0, 1, 2, 4 and 5 have 1, 2, 3, 5 and 6.
  EXPECT_EQ(with["columns"]["mine.replans"]["count"], 5);
  EXPECT_EQ(with["columns"]["mine.replans"]["mean"], 3.4);
  EXPECT_EQ(with["metrics"]["mine.replans"]["mean"], 3.4);
  EXPECT_EQ(with["metrics_by_outcome"]["goal_reached"]["mine.replans"]["mean"], 3.5);
  EXPECT_EQ(with["columns"]["other.looks"]["count"], 0);
  EXPECT_FALSE(with["metrics"].contains("other.looks")) << "no value, as of any metric";
  // The control: all else is the summary of the run without them.
  json rest = with;
  for (const char* key : {"columns", "metrics"}) {
    rest[key].erase("mine.replans");
    rest[key].erase("other.looks");
  }
  for (json& metrics : rest["metrics_by_outcome"]) metrics.erase("mine.replans");
  EXPECT_EQ(rest,
            json::parse(SummaryJson(SampleDescription(),
                                    statistics::Summarize(SampleSchema(), SampleRecords(), 8))));
}

TEST(OwnValues, HaveALineInTheTable) {
  truth::RecordSchema schema = OwnSchema();
  schema[8] = {"mine.a_name_that_is_much_longer_than_its_column", "m\x1b[31m", "hostile"};
  const auto text = [&](const truth::RecordSchema& of) {
    return SummaryText(SampleDescription(), statistics::Summarize(of, OwnRecords(), 8));
  };
  EXPECT_THAT(text(OwnSchema()), core::Says("\n  mine.replans                  3.40"));
  EXPECT_THAT(text(OwnSchema()), Not(HasSubstr("other.looks")));
  EXPECT_THAT(text(schema), HasSubstr("mine.a_name_that_is_m..."));
  for (const std::string& line : Lines(text(schema))) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_EQ(text(schema).find('\x1b'), std::string::npos);
  EXPECT_THAT(
      SummaryText(SampleDescription(), statistics::Summarize(SampleSchema(), SampleRecords(), 8)),
      Not(HasSubstr("mine.")));
}

TEST(OwnValues, AreToldTwelveAtMostInTheTable) {
  truth::RecordSchema schema = SampleSchema();
  std::vector<Record> records = SampleRecords();
  for (int i = 0; i < 14; ++i) {
    schema.push_back({"mine.v" + std::to_string(i), "1", ""});
    for (Record& record : records) {
      if (!truth::IsFault(record)) record.values.push_back(static_cast<double>(i));
    }
  }
  EXPECT_THAT(SummaryText(SampleDescription(), statistics::Summarize(schema, records, 8)),
              AllOf(HasSubstr("mine.v11"), Not(HasSubstr("mine.v12")),
                    HasSubstr("and 2 more: summary.json")));
}

// Navigator b counts, a does not.
SweepSummary OwnSweep(const scenario::Sweep& sweep) {
  return SummarizeSweep(
      sweep,
      [](std::size_t cell) {
        SweepCellTrials trials = Trials(10, 9.0);
        trials.schema.push_back({"b.replans", "1", "plans made anew"});
        for (Record& record : trials.prefix) {
          if (truth::IsFault(record)) continue;
          const auto count = static_cast<double>(cell * 10 + record.trial % 3);
          record.values.push_back(cell < 4 ? kNaN : count);
        }
        return trials;
      },
      kWilson);
}

TEST(OwnValues, OfASweepHaveADashWhereAnotherNavigatorDrives) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = OwnSweep(sweep);
  const std::string text = SweepText(sweep, summary, {}, TextStyle::kPlain);
  const std::size_t table = text.find("counted by navigators");
  ASSERT_NE(table, std::string::npos);
  const std::vector<std::string> lines = Lines(text.substr(table));
  EXPECT_TRUE(lines[0].ends_with(" b.replans"));
  for (std::size_t cell = 0; cell < 8; ++cell) {
    EXPECT_EQ(lines[cell + 1].ends_with(" -"), cell < 4) << lines[cell + 1];
  }
  // 39 trials of 40, 41 and 42: a mean of 41.
  EXPECT_THAT(lines[5], HasSubstr(" 41.00 (4"));
  for (const std::string& line : Lines(text)) EXPECT_LE(line.size(), 100u) << line;
  const std::vector<std::string> rows = Lines(SweepCurvesCsv(sweep, summary));
  std::vector<std::string> own;
  std::ranges::copy_if(rows, std::back_inserter(own), [](const std::string& row) {
    return row.find(",b.replans,") != std::string::npos;
  });
  ASSERT_EQ(own.size(), 8u);
  EXPECT_EQ(own[0], "0,a,0.002,b.replans,1,0,,,,,,");
  EXPECT_THAT(own[4], testing::StartsWith("4,b,0.002,b.replans,1,39,41"));
  const json told = json::parse(SweepJson(sweep, summary, {}));
  EXPECT_TRUE(told["cells"][0]["metrics"]["b.replans"]["mean"].is_null());
  EXPECT_NEAR(told["cells"][4]["metrics"]["b.replans"]["mean"].get<double>(), 41.0, 1e-9);
  // The control: nothing of it in a sweep whose navigators count nothing.
  EXPECT_THAT(SweepText(sweep, Summary(sweep), {}, TextStyle::kPlain),
              Not(HasSubstr("counted by navigators")));
}

Baseline BaselineOf(const truth::RecordSchema& schema, const std::vector<Record>& records) {
  BaselineCell cell{.name = "c",
                    .scenario = "s",
                    .fingerprint = "f",
                    .resolved = "{}",
                    .seed = 1,
                    .trial_hash = "h",
                    .outcomes = {},
                    .metrics = {}};
  FillBaselineCell(schema, records, cell);
  return {.name = "n", .reason = "r", .build = "b", .cells = {cell}};
}

TEST(OwnValues, AreKeptByABaselineAndReadBack) {
  const std::string text = BaselineJson(BaselineOf(OwnSchema(), OwnRecords()));
  EXPECT_THAT(text, core::Says("\"mine.replans\""));
  std::vector<std::string> unknown;
  const Baseline read = ParseBaseline(core::ParseJson(text, "baseline"), &unknown);
  EXPECT_THAT(unknown, IsEmpty());
  const statistics::BaselineMetric& own = read.cells.at(0).metrics.back();
  EXPECT_EQ(own.name, "mine.replans");
  EXPECT_DOUBLE_EQ(own.margin, 0.34);
  ASSERT_EQ(own.values.size(), 6u);
  EXPECT_EQ(own.values[2], 3.0);
  EXPECT_TRUE(std::isnan(own.values[3])) << "a fault";
  const std::string plain = BaselineJson(BaselineOf(SampleSchema(), SampleRecords()));
  EXPECT_THAT(plain, Not(HasSubstr("mine.")));
  // Another name without a dot is of another version of this program.
  std::string other = text;
  for (std::size_t at = 0; (at = other.find("mine.replans", at)) != std::string::npos;) {
    other.replace(at, 12, "smoothness");
  }
  ParseBaseline(core::ParseJson(other, "baseline"), &unknown);
  EXPECT_THAT(unknown, ElementsAre("smoothness"));
}

ComparedRun Compared(std::string name, truth::RecordSchema schema,
                     const std::vector<Record>& records, std::uint64_t seed = 1) {
  return {std::move(name), seed, std::move(schema), records, "rocks"};
}

TEST(OwnValues, ThatOneRunCountsAreNamedAndLeftOut) {
  const std::vector<Record> plain = SampleRecords();
  const std::vector<Record> own = OwnRecords();
  for (const std::uint64_t seed : {1u, 2u}) {
    const ComparedRun a = Compared("a", SampleSchema(), plain);
    const ComparedRun b = Compared("b", OwnSchema(), own, seed);
    const RunComparison result = CompareRuns(a, b);
    EXPECT_THAT(result.only_first, IsEmpty());
    EXPECT_THAT(result.only_second, ElementsAre("mine.replans")) << "other.looks has no value";
    EXPECT_THAT(RunComparisonText(a, b, result),
                HasSubstr("Counted by the navigator of B alone, and left out: mine.replans."));
    EXPECT_THAT(CompareRuns(b, a).only_first, ElementsAre("mine.replans"));
    const json page = json::parse(PageComparisonJson({"a", "b", result, {}}, false));
    EXPECT_THAT(page["notes"].back(),
                HasSubstr("navigator of b alone, and left out: mine.replans"));
  }
}

// Both runs have the column, but another navigator drives the first.
TEST(OwnValues, OfAnotherNavigatorAreNamedToo) {
  std::vector<Record> none = OwnRecords();
  for (Record& record : none) {
    if (!truth::IsFault(record)) record.values[8] = kNaN;
  }
  const std::vector<Record> own = OwnRecords();
  const ComparedRun a = Compared("a", OwnSchema(), none);
  const ComparedRun b = Compared("b", OwnSchema(), own);
  EXPECT_THAT(CompareRuns(a, b).only_second, ElementsAre("mine.replans"));
  const std::string text = RunComparisonText(a, b, CompareRuns(a, b));
  EXPECT_THAT(text, HasSubstr("by the navigator of B alone"));
  EXPECT_THAT(text, Not(HasSubstr("\n  mine.replans")));
}

TEST(OwnValues, OfBothRunsAreCompared) {
  const std::vector<Record> first = OwnRecords();
  std::vector<Record> second = first;
  for (Record& record : second) {
    if (!truth::IsFault(record)) record.values[8] += 2.0;
  }
  const ComparedRun a = Compared("a", OwnSchema(), first);
  const ComparedRun b = Compared("b", OwnSchema(), second);
  const RunComparison result = CompareRuns(a, b);
  EXPECT_THAT(result.only_first, IsEmpty());
  EXPECT_THAT(result.only_second, IsEmpty());
  const auto column = std::ranges::find_if(
      result.columns, [](const ColumnComparison& each) { return each.name == "mine.replans"; });
  ASSERT_NE(column, result.columns.end());
  EXPECT_DOUBLE_EQ(column->difference, 2.0);
  const std::string text = RunComparisonText(a, b, result);
  EXPECT_THAT(text, core::Says("\n  mine.replans"));
  EXPECT_THAT(text, Not(HasSubstr("left out:")));
  EXPECT_THAT(RunComparisonCsv(result), HasSubstr("\nall,mine.replans,1,5,3.4,5.4,2,"));
}

TEST(OwnValues, StandOnThePageWithTheirMeaning) {
  const std::vector<Record> records = OwnRecords();
  const std::vector<std::size_t> places{0, 1};
  const json page = json::parse(PageTrialsJson(OwnSchema(), records, places));
  EXPECT_EQ(page["columns"][8]["name"], "mine.replans");
  EXPECT_EQ(page["columns"][8]["meaning"], "plans made anew");
  EXPECT_EQ(page["columns"][8]["values"], json({1, 2}));
  EXPECT_EQ(page["columns"][9]["values"], json({nullptr, nullptr}));
  EXPECT_FALSE(page["columns"][0].contains("meaning"));
}

TEST(OwnValues, AreListedAmongTheMetrics) {
  const std::string text = MetricTableText(OwnSchema());
  EXPECT_TRUE(text.starts_with(MetricTableText()));
  EXPECT_THAT(text, core::Says("mine.replans", "plans made anew"));
  EXPECT_THAT(MetricTableMarkdown(OwnSchema()),
              HasSubstr("| `mine.replans` | 1 | all | plans made anew | mine.replans | 10 % |"));
}

}  // namespace
}  // namespace rockyard::report
