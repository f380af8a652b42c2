// What the report page is given of comparisons: with publications, along a sweep, between runs.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/json_text.h"
#include "report/comparison_reference.h"
#include "report/page_data.h"
#include "report/sweep_summary.h"
#include "sample_run.h"
#include "sample_sweep.h"

namespace rockyard::report {
namespace {

using nlohmann::json;

statistics::PublishedReference Reference() {
  return ParseReference(core::ParseJson(R"({
    "schema_version": 1, "title": "Someone 1999", "citation": "<b>Someone</b>",
    "values": [
      {"id": "a", "what": "declared successful", "place": "sec. 7", "scenario": "sample",
       "statistic": "outcome_count", "sample_size": 40, "outcomes": ["goal_reached", "false_goal"],
       "value": 39, "unit": "runs", "note": "in a sandbox"},
      {"id": "b", "what": "mode", "place": "fig. 17", "scenario": "sample", "statistic": "mode",
       "sample_size": 40, "column": "true_distance_m", "value": 8.5, "rounding": 0.1, "unit": "m"},
      {"id": "c", "what": "elsewhere", "place": "", "scenario": "other", "statistic": "mode",
       "sample_size": 5, "column": "true_distance_m", "value": 8.5, "rounding": 0.1, "unit": "m"}
    ]})",
                                        "test"));
}

statistics::ComparisonResult Compared(const std::vector<truth::Record>& records) {
  return statistics::Compare(
      Reference(), std::vector<statistics::ScenarioRun>{{"sample", SampleSchema(), records, 1.0}},
      {.replicates = 200});
}

TEST(PagePublished, HasTheRowsOfItsScenario) {
  const std::vector<truth::Record> records = SampleRecords();
  const statistics::ComparisonResult result = Compared(records);
  const json table = json::parse(PublishedJson(Reference(), result, "sample"));
  EXPECT_EQ(table["reference"], "Someone 1999");
  EXPECT_EQ(table["citation"], "<b>Someone</b>");
  ASSERT_EQ(table["rows"].size(), 2u);
  EXPECT_EQ(PublishedJson(Reference(), result, "nowhere"), "null");
}

TEST(PagePublished, ACountIsTextAndRate) {
  const std::vector<truth::Record> records = SampleRecords();
  const statistics::ComparisonResult result = Compared(records);
  const json row = json::parse(PublishedJson(Reference(), result, "sample"))["rows"][0];
  EXPECT_EQ(row["published"], "39/40");
  EXPECT_DOUBLE_EQ(row["published_value"].get<double>(), 39.0 / 40.0);
  EXPECT_DOUBLE_EQ(row["predicted_value"].get<double>(), result.values[0].median / 40.0);
  EXPECT_DOUBLE_EQ(row["predicted_low"].get<double>(), result.values[0].interval.low / 40.0);
  EXPECT_DOUBLE_EQ(row["p_holm"].get<double>(), result.values[0].holm_p_value);
  EXPECT_EQ(row["verdict"], statistics::Name(result.values[0].verdict));
  EXPECT_EQ(row["source"], "sec. 7; in a sandbox");
}

TEST(PagePublished, ANumberKeepsItsUnitAndWhatIsUnknownIsNull) {
  const std::vector<truth::Record> none;
  const json row = json::parse(PublishedJson(Reference(), Compared(none), "sample"))["rows"][1];
  EXPECT_EQ(row["unit"], "m");
  EXPECT_EQ(row["published"], "8.5");
  EXPECT_EQ(row["published_value"], 8.5);
  EXPECT_TRUE(row["predicted_value"].is_null());
  EXPECT_TRUE(row["p_holm"].is_null());
  EXPECT_EQ(row["verdict"], statistics::Name(statistics::Verdict::kNotJudged));
}

TEST(PageSweep, HoldsItsSummaryAndItsCurves) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = Summary(sweep);
  const SweepDescription description{.trial_hash = "12"};
  const json page = json::parse(PageSweepJson("label", "folder", sweep, summary, description));
  EXPECT_EQ(page["label"], "label");
  EXPECT_EQ(page["summary"], json::parse(SweepJson(sweep, summary, description)));
  ASSERT_EQ(page["curves"].size(), 2 * summary.curves.size());
  const json& curve = page["curves"][1];
  EXPECT_EQ(curve["success"], "true");
  EXPECT_EQ(curve["axis"], "k_per_m2");
  EXPECT_EQ(curve["label"], summary.curves[0].label);
  ASSERT_EQ(curve["points"].size(), summary.curves[0].cells.size());
  const statistics::Proportion& rate = summary.cells[summary.curves[0].cells[0]].true_success.rate;
  EXPECT_EQ(curve["points"][0]["x"], 0.002);
  EXPECT_EQ(curve["points"][0]["rate"], rate.rate);
  EXPECT_EQ(curve["points"][0]["low"], rate.interval.low);
  EXPECT_EQ(curve["points"][0]["trials"], rate.trials);
}

TEST(PageSweep, DrawsTheFitThatTheCsvHas) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = Summary(sweep);
  const json page = json::parse(PageSweepJson("", "", sweep, summary, {}));
  const json& curve = page["curves"][0];
  const std::vector<FitPoint> line = FittedLine(summary.curves[0].fits[0]);
  ASSERT_EQ(line.size(), 61u);
  ASSERT_EQ(curve["fit"].size(), line.size());
  EXPECT_EQ(curve["fit_status"], "fitted");
  EXPECT_DOUBLE_EQ(curve["fit"][0]["x"].get<double>(), 0.002);
  EXPECT_DOUBLE_EQ(curve["fit"][60]["x"].get<double>(), 0.016);
  EXPECT_EQ(curve["fit"][30]["rate"], line[30].rate);
  EXPECT_EQ(curve["fit"][30]["high"], line[30].band.high);
}

TEST(PageSweep, AFitIsRejectedWhereTheTerminalSaysSo) {
  const scenario::Sweep sweep = TestSweep();
  SweepSummary summary = Summary(sweep);
  const auto rejected = [&](double p) {
    summary.curves[0].fits[0].p_value = p;
    return json::parse(PageSweepJson("", "", sweep, summary, {}))["curves"][0]["fit_rejected"];
  };
  EXPECT_EQ(rejected(0.5 * kMisfit), true);
  EXPECT_EQ(rejected(2.0 * kMisfit), false);
  EXPECT_TRUE(rejected(std::nan("")).is_null());
}

TEST(PageSweep, SaysWhyThereIsNoFit) {
  const scenario::Sweep sweep = TestSweep();
  const SweepSummary summary = SummarizeSweep(
      sweep, [](std::size_t) { return Trials(0, 10.0); }, statistics::IntervalMethod::kWilson);
  const json page = json::parse(PageSweepJson("", "", sweep, summary, {}));
  EXPECT_TRUE(page["curves"][0]["fit"].empty());
  EXPECT_EQ(page["curves"][0]["fit_status"], "every trial ended alike");
  EXPECT_TRUE(page["curves"][0]["fit_rejected"].is_null());
}

PageComparison OfTwo(double p, double difference) {
  PageComparison page{.first = "a", .second = "b", .comparison = {}, .settings = {}};
  page.comparison.paired = true;
  page.comparison.pairs = 12;
  page.comparison.same_terrain = true;
  page.comparison.successes = {{.what = "declared success",
                                .first = statistics::MakeProportion(6, 12),
                                .second = statistics::MakeProportion(9, 12),
                                .difference = difference,
                                .interval = {0.0, 0.5},
                                .p_value = p,
                                .counts = {}}};
  page.comparison.columns = {{.name = "energy_wh",
                              .unit = "Wh",
                              .count = 0,
                              .first_mean = std::nan(""),
                              .second_mean = 1.5,
                              .difference = std::nan(""),
                              .interval = {std::nan(""), std::nan("")}}};
  page.settings = {{"navigation.kind", "gestalt", "<i>"}};
  return page;
}

TEST(PageComparison, HasNullForWhatIsUndefined) {
  const json page = json::parse(PageComparisonJson(OfTwo(std::nan(""), 0.25), false));
  EXPECT_EQ(page["pairs"], 12);
  EXPECT_EQ(page["paired"], true);
  EXPECT_EQ(page["successes"][0]["second"], 0.75);
  EXPECT_TRUE(page["successes"][0]["p"].is_null());
  EXPECT_EQ(page["columns"][0]["trials"], "all");
  EXPECT_TRUE(page["columns"][0]["first"].is_null());
  EXPECT_TRUE(page["columns"][0]["low"].is_null());
  EXPECT_EQ(page["columns"][0]["second"], 1.5);
  EXPECT_EQ(page["settings"][0]["second"], "<i>");
}

TEST(PageComparison, TwoSamplesHaveASizeEach) {
  PageComparison two = OfTwo(0.1, 0.25);
  two.comparison.columns[0].count = 25;
  two.comparison.columns[0].second_count = 30;
  const auto column = [&] { return json::parse(PageComparisonJson(two, false))["columns"][0]; };
  EXPECT_EQ(column()["n"], 25);
  EXPECT_TRUE(column()["n_second"].is_null());
  two.comparison.paired = false;
  EXPECT_EQ(column()["n_second"], 30);
}

TEST(PageComparison, SaysWhatPairsAreMadeOf) {
  PageComparison pair = OfTwo(0.1, 0.25);
  const auto notes = [&] { return PageComparisonJson(pair, false); };
  EXPECT_THAT(notes(), testing::HasSubstr("equal rocks and equal noise"));
  EXPECT_THAT(notes(), testing::Not(testing::HasSubstr("share layouts")));
  pair.comparison.same_terrain = false;
  pair.comparison.shared_layouts = true;
  EXPECT_THAT(notes(), testing::HasSubstr("other settings of terrain"));
  EXPECT_THAT(notes(), testing::HasSubstr("share layouts"));
  pair.comparison.paired = false;
  EXPECT_THAT(notes(), testing::HasSubstr("two samples"));
}

TEST(PageComparison, SeveralPairsAreOneFamily) {
  std::vector<PageComparison> pairs{OfTwo(0.01, 0.2), OfTwo(std::nan(""), 0.1), OfTwo(0.03, 0.1)};
  AdjustSuccesses(pairs);
  EXPECT_DOUBLE_EQ(pairs[0].comparison.successes[0].p_value, 0.02);
  EXPECT_TRUE(std::isnan(pairs[1].comparison.successes[0].p_value));
  EXPECT_DOUBLE_EQ(pairs[2].comparison.successes[0].p_value, 0.03);
}

TEST(Page, PutsItsPartsTogether) {
  core::Provenance provenance;
  provenance.version = "0.1.0";
  const std::vector<std::string> runs{R"({"label":"a"})", R"({"label":"b"})"};
  const json page = json::parse(PageJson({.title = "<title>",
                                          .command = "rockyard report a b",
                                          .why_none_published = "nowhere",
                                          .provenance = provenance},
                                         runs, {}, {}));
  EXPECT_EQ(page["version"], 1);
  EXPECT_EQ(page["title"], "<title>");
  EXPECT_EQ(page["why_none_published"], "nowhere");
  EXPECT_EQ(page["provenance"]["version"], "0.1.0");
  EXPECT_EQ(page["runs"][1]["label"], "b");
  EXPECT_TRUE(page["sweeps"].empty());
}

}  // namespace
}  // namespace rockyard::report
