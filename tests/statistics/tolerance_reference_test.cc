// The committed numbers of hazard detection, and mistakes in such a file.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "report/baseline.h"
#include "report/comparison_reference.h"
#include "report/comparison_table.h"
#include "report/parameter_table.h"
#include "statistics/published_comparison.h"

namespace rockyard::report {
namespace {

using Ids = std::set<std::string>;
using statistics::StatisticKind;
using statistics::Verdict;
using testing::HasSubstr;

statistics::PublishedReference HazardDetection() {
  return LoadReference(ROCKYARD_SOURCE_DIR "/results/reference/matthies1995_hazard_detection.json");
}

TEST(HazardReference, ItsArithmeticAgrees) {
  const statistics::ComparisonResult result = statistics::Compare(HazardDetection(), {});
  std::set<std::string> computed;
  for (const statistics::ComparedValue& value : result.values) {
    if (value.published.statistic == StatisticKind::kComputed) {
      EXPECT_EQ(value.verdict, Verdict::kHolds) << value.published.id;
      computed.insert(value.published.id);
    } else {
      EXPECT_EQ(value.verdict, Verdict::kNotJudged) << value.published.id;
    }
  }
  for (const char* id :
       {"false_alarm.any_point", "net_rate.computed", "power.sum", "resolution.equation"}) {
    EXPECT_TRUE(computed.contains(id)) << id;
  }
  EXPECT_THAT(ComparisonText(HazardDetection(), result), HasSubstr("underpowered: across an end"));
}

// What a reference of arithmetic alone says of the simulation is nothing, and its foot says so.
TEST(MissionReference, ItsArithmeticAgreesButForTheContradictionOfThePaper) {
  const statistics::PublishedReference reference =
      LoadReference(ROCKYARD_SOURCE_DIR "/results/reference/matthies1995_mission.json");
  const statistics::ComparisonResult result = statistics::Compare(reference, {});
  for (const statistics::ComparedValue& value : result.values) {
    EXPECT_EQ(value.published.statistic, StatisticKind::kComputed) << value.published.id;
    const bool contradicts_itself = value.published.id == "power.table1_lasers";
    EXPECT_EQ(value.verdict, contradicts_itself ? Verdict::kDiffers : Verdict::kHolds)
        << value.published.id;
    // A tolerance that holds the published number itself.
    EXPECT_GE(value.published.value, value.published.low) << value.published.id;
    EXPECT_LE(value.published.value, value.published.high) << value.published.id;
  }
  EXPECT_THAT(ComparisonText(reference, result), HasSubstr("; 27 of them computed, not simulated"));
}

TEST(HazardReference, TheTraverseIsJudgedByTheGivenTolerance) {
  const statistics::PublishedReference reference = HazardDetection();
  const auto traverse = std::find_if(reference.values.begin(), reference.values.end(),
                                     [](const auto& value) { return value.id == "traverse"; });
  ASSERT_NE(traverse, reference.values.end());
  EXPECT_EQ(traverse->low, 30.0);
  EXPECT_EQ(traverse->high, 33.0);
}

std::string ProblemsOf(const std::string& members) {
  const std::string text = R"({"schema_version": 1, "title": "t", "citation": "c", "values": [)"
                           R"({"id": "x", "what": "w", "place": "p", )" +
                           members + "}]}";
  return core::RefusalOf([&] { ParseReference(core::ParseJson(text, "test")); });
}

TEST(HazardReference, MistakesAreNamed) {
  const std::string rate =
      R"("statistic": "rate", "scenario": "s", "column": "missed", "of": "hazards", "value": 1)";
  EXPECT_EQ(ProblemsOf(rate + R"(, "low": 0, "high": 1)"), "");
  EXPECT_THAT(ProblemsOf(rate), HasSubstr("are no tolerance"));
  EXPECT_THAT(ProblemsOf(rate + R"(, "low": 2, "high": 1)"), HasSubstr("are no tolerance"));
  EXPECT_THAT(ProblemsOf(rate + R"(, "low": 0, "sample_size": 3)"), HasSubstr("sample_size"));
  EXPECT_THAT(ProblemsOf(rate + R"(, "low": 0, "arrived": 3)"), HasSubstr("has no sample"));
  EXPECT_THAT(ProblemsOf(rate + R"(, "low": 0, "along": "height_m")"),
              HasSubstr("abscissa of a crossing"));
  EXPECT_THAT(ProblemsOf(rate + R"(, "low": 0, "formula": "sum")"), HasSubstr("is simulated"));
  EXPECT_THAT(ProblemsOf(rate + R"(, "low": 0, "where": [{"low": 1}])"),
              HasSubstr("where[0].column"));
  EXPECT_THAT(
      ProblemsOf(R"("statistic": "computed", "formula": "any_of", "inputs": [1], "low": 0)"),
      HasSubstr("are not as many as the formula takes"));
  EXPECT_THAT(
      ProblemsOf(
          R"("statistic": "computed", "formula": "power_law_cover", "inputs": [1, 1, 2], "low": 0)"),
      HasSubstr("outside of what the formula holds for"));
  EXPECT_THAT(ProblemsOf(R"("statistic": "computed", "inputs": [1], "low": 0)"),
              HasSubstr("name a closed form"));
  EXPECT_THAT(ProblemsOf(R"("statistic": "mode", "scenario": "s", "column": "c", "sample_size": 9,)"
                         R"("value": 1, "low": 0)"),
              HasSubstr("has no tolerance"));
}

TEST(RatioSumReference, MistakesAreNamed) {
  const std::string sum = R"("statistic": "ratio_sum", "scenario": "s", "value": 1, "low": 0)";
  const auto with = [&](const std::string& terms) { return ProblemsOf(sum + ", " + terms); };
  const std::string term = R"({"columns": ["a", "b"], "of": "c"})";
  EXPECT_EQ(with(R"("terms": [)" + term + "]"), "");
  EXPECT_THAT(ProblemsOf(sum), HasSubstr("belong to ratio_sum"));
  EXPECT_THAT(with(R"("column": "d", "terms": [)" + term + "]"),
              HasSubstr("beside the columns of terms"));
  EXPECT_THAT(with(R"("of": "d", "terms": [)" + term + "]"), HasSubstr("base of a rate"));
  EXPECT_THAT(with(R"("terms": [{"columns": ["a"]}])"), HasSubstr("terms[0].of"));
  EXPECT_THAT(with(R"("terms": [{"of": "c"}])"), HasSubstr("terms[0].columns: is missing"));
  EXPECT_THAT(with(R"("terms": [{"columns": [1], "of": "c"}])"),
              HasSubstr("terms[0].columns[0]: is no text"));
  EXPECT_THAT(ProblemsOf(R"("statistic": "ratio", "scenario": "s", "column": "a", "of": "b",)"
                         R"("value": 1, "low": 0, "terms": [)" +
                         term + "]"),
              HasSubstr("belong to ratio_sum"));
  EXPECT_THAT(ProblemsOf(R"("statistic": "mode", "scenario": "s", "column": "c", "sample_size": 9,)"
                         R"("value": 1, "terms": [)" +
                         term + "]"),
              HasSubstr("the statistic has none"));
  EXPECT_THAT(ProblemsOf(R"("statistic": "computed", "formula": "sum", "inputs": [1], "low": 0,)"
                         R"("terms": [)" +
                         term + "]"),
              HasSubstr("nothing is simulated"));
}

// Every outcome that Matthies 1995 states has a row in a reference, or a reason why it has none.

Ids IdsOfReferences() {
  Ids ids;
  for (const char* file : {"matthies1995", "matthies1995_hazard_detection", "matthies1995_mission",
                           "matthies1995_dead_reckoning", "matthies1995_cylinder"}) {
    const auto path = std::string(ROCKYARD_SOURCE_DIR "/results/reference/") + file + ".json";
    for (const auto& value : LoadReference(path).values) {
      EXPECT_TRUE(ids.insert(value.id).second) << value.id << " stands in two references";
    }
  }
  return ids;
}

const std::vector<core::JsonValue>& Targets() {
  static const core::JsonValue document =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/tests/data/matthies1995_targets.json");
  return document.Find("targets")->list();
}

// Names of rows that are not among `ids`, and of targets with neither a row nor a reason.
Ids Unanswered(const Ids& ids) {
  Ids missing;
  for (const core::JsonValue& target : Targets()) {
    const core::JsonValue* rows = target.Find("rows");
    const core::JsonValue* reason = target.Find("reason");
    const bool answered = rows != nullptr ? !rows->list().empty() && reason == nullptr
                                          : reason != nullptr && !reason->text().empty();
    if (!answered) missing.insert(target.Find("id")->text());
    if (rows == nullptr) continue;
    for (const core::JsonValue& row : rows->list()) {
      if (!ids.contains(row.text())) missing.insert(row.text());
    }
  }
  return missing;
}

TEST(PublishedTargets, EachHasARowOrAReason) {
  const Ids ids = IdsOfReferences();
  EXPECT_EQ(Targets().size(), 67u);
  EXPECT_EQ(Unanswered(ids), Ids());
}

// Negative control: a row that is taken out of its reference is missed.
TEST(PublishedTargets, ARowThatIsGoneIsMissed) {
  Ids ids = IdsOfReferences();
  for (const char* id : {"nominal.success", "traverse.hour", "moore.cover_vl2"}) ids.erase(id);
  EXPECT_EQ(Unanswered(ids), (Ids{"nominal.success", "traverse.hour", "moore.cover_vl2"}));
}

// Baselines as files, and the table of metrics in README.md.

Baseline SampleBaseline() {
  using truth::TrialOutcome;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const truth::RecordSchema schema = {{"max_tilt_deg", "deg", ""}, {"sim_time_s", "s", ""}};
  const std::vector<truth::Record> records = {{0, TrialOutcome::kGoalReached, "", {5.1234567, 10}},
                                              {1, TrialOutcome::kJammed, "", {nan, 20}},
                                              {2, TrialOutcome::kSimulatorFault, "", {}}};
  BaselineCell cell{.name = "a \"cell\"",
                    .scenario = "s",
                    .fingerprint = "f",
                    .resolved = "{\"k\": 1}",
                    .seed = 9000000000000000001ULL,
                    .trial_hash = "h",
                    .outcomes = {},
                    .metrics = {}};
  FillBaselineCell(schema, records, cell);
  return {.name = "n", .reason = "because", .build = "b", .cells = {cell}};
}

TEST(Baseline, ReadsBackWhatWasWritten) {
  const Baseline before = SampleBaseline();
  const core::JsonValue json = core::ParseJson(BaselineJson(before), "baseline");
  ASSERT_TRUE(IsBaseline(json));
  const Baseline after = ParseBaseline(json);
  ASSERT_EQ(after.cells.size(), 1u);
  EXPECT_EQ(after.cells[0].name, "a \"cell\"");
  EXPECT_EQ(after.cells[0].seed, 9000000000000000001ULL);
  EXPECT_EQ(after.cells[0].outcomes, before.cells[0].outcomes);
  ASSERT_EQ(after.cells[0].metrics.size(), before.cells[0].metrics.size());
  for (std::size_t i = 0; i < after.cells[0].metrics.size(); ++i) {
    const statistics::BaselineMetric& a = before.cells[0].metrics[i];
    const statistics::BaselineMetric& b = after.cells[0].metrics[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.margin, b.margin);
    ASSERT_EQ(b.values.size(), 3u);
    for (std::size_t t = 0; t < 3; ++t) {
      EXPECT_TRUE(a.values[t] == b.values[t] ||
                  (std::isnan(a.values[t]) && std::isnan(b.values[t])));
    }
  }
}

// A mean of 0 gives a relative margin no scale; the file must still be one that can be read.
TEST(Baseline, AMetricThatIsAlwaysZeroHasAMargin) {
  const truth::RecordSchema schema = {{"true_distance_m", "m", ""}};
  const std::vector<truth::Record> records = {{0, truth::TrialOutcome::kJammed, "", {0.0}},
                                              {1, truth::TrialOutcome::kJammed, "", {0.0}}};
  Baseline still = SampleBaseline();
  BaselineCell& cell = still.cells[0];
  cell.outcomes.clear();
  cell.metrics.clear();
  FillBaselineCell(schema, records, cell);
  const Baseline read = ParseBaseline(core::ParseJson(BaselineJson(still), "baseline"));
  for (const statistics::BaselineMetric& metric : read.cells.at(0).metrics) {
    EXPECT_GT(metric.margin, 0.0) << metric.name;
  }
  EXPECT_EQ(read.cells[0].metrics.back().values, std::vector<double>(2, 0.0));
}

TEST(Baseline, EveryMistakeIsNamed) {
  const core::JsonValue json = core::ParseJson(
      R"({"kind": "rockyard_baseline", "schema_version": 2, "name": 1, "reason": "r", "build": "b",
          "cells": [{"name": "c", "scenario": "s", "fingerprint": "f", "trial_hash": "h",
                     "seed": "x", "outcomes": "G?", "resolved": {},
                     "margins": {"max_tilt_deg": 0}, "metrics": {"max_tilt_deg": ["a"]}}]})",
      "baseline");
  EXPECT_EQ(core::ProblemsIn([&] { ParseBaseline(json); }).size(), 6u);
}

TEST(MetricTable, StandsInTheReadme) {
  std::ifstream file(ROCKYARD_SOURCE_DIR "/src/statistics/README.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find(MetricTableMarkdown()), std::string::npos)
      << "put the output of rockyard metrics --markdown into src/statistics/README.md";
}

}  // namespace
}  // namespace rockyard::report
