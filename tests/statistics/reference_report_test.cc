// The committed reference, its parser, and the tables made from a comparison.

#include <set>
#include <sstream>

#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "core/says.h"
#include "report/comparison_reference.h"
#include "report/comparison_table.h"
#include "synthetic_trials.h"

namespace rockyard::report {
namespace {

using statistics::ComparisonResult;
using statistics::PublishedReference;
using statistics::RunOf;
using statistics::Verdict;
using testing::HasSubstr;

PublishedReference Matthies() {
  return LoadReference(ROCKYARD_SOURCE_DIR "/results/reference/matthies1995.json");
}

// All scenarios with trials of the synthetic law; the verdicts mean nothing here.
ComparisonResult CompareSynthetic(std::size_t replicates = 500) {
  const auto records = statistics::SyntheticTrials({}, 3, 300);
  const auto perfect = statistics::SyntheticTrials({.shortest_m = 7.55}, 4, 300);
  const std::vector<statistics::ScenarioRun> runs = {
      RunOf("obstacles_0.28", records), RunOf("obstacles_0.57", records),
      RunOf("obstacles_0.85", records), RunOf("nominal", records),
      RunOf("nominal_perfect_localization", perfect)};
  return statistics::Compare(Matthies(), runs, {.seed = 1, .replicates = replicates});
}

TEST(Reference, TheCommittedFileParses) {
  const PublishedReference reference = Matthies();
  EXPECT_EQ(reference.values.size(), 29u);
  EXPECT_FALSE(reference.misprints.empty());
  const auto& success = reference.values[4];
  EXPECT_EQ(success.id, "nominal.success");
  EXPECT_EQ(success.value, 39.0);
  EXPECT_EQ(success.sample_size, 40);
  EXPECT_EQ(success.outcomes.size(), 2u);
}

std::string ProblemsOf(const char* text) {
  return core::RefusalOf([&] { ParseReference(core::ParseJson(text, "test")); });
}

TEST(Reference, EveryMistakeIsNamedWithItsPath) {
  EXPECT_THAT(ProblemsOf("[1]"), HasSubstr("object"));
  EXPECT_THAT(ProblemsOf("{}"), HasSubstr("schema_version"));
  EXPECT_THAT(ProblemsOf(R"({"schema_version": 2})"), HasSubstr("schema_version"));
  EXPECT_THAT(ProblemsOf(R"({"schema_version": 1})"), HasSubstr("values"));
  EXPECT_THAT(ProblemsOf(R"({"schema_version": 1, "values": 3})"), HasSubstr("not a list"));
  const std::string text = ProblemsOf(R"({"schema_version": 1, "extra": 0, "values": [
    {"id": "a", "scenario": "s", "statistic": "outcome_count", "sample_size": 6,
     "outcomes": ["goal_reachd"], "value": 4},
    {"id": "b", "scenario": "s", "statistic": "minimun", "sample_size": 6},
    {"id": "c", "scenario": "s", "statistic": "outcome_count", "sample_size": 6,
     "outcomes": ["no_path"], "value": 7},
    {"id": "c", "scenario": "s", "statistic": "minimum", "sample_size": 6}]})");
  EXPECT_THAT(text,
              core::Says("extra", "values[0].outcomes[0]", "goal_reached", "values[1].statistic",
                         "values[2].value", "values[3].id", "values[3].column", "values[3].value"));
}

TEST(Reference, FailureKindsMustAddUp) {
  const char* text = R"({"schema_version": 1, "values": [
    {"id": "a", "scenario": "s", "statistic": "failure_kinds", "sample_size": 2,
     "kinds": [{"name": "jam", "outcomes": ["jammed"], "count": 1}]}]})";
  EXPECT_THAT(ProblemsOf(text), HasSubstr("values[0].kinds"));
}

TEST(Reference, ArrivalsBelongToSetsThatCanBeSplit) {
  const std::string head = R"({"schema_version": 1, "values": [{"id": "a", "scenario": "s",
    "sample_size": 6, "value": 4, )";
  const std::string mode = head + R"("statistic": "mode", "column": "x", "arrived": )";
  EXPECT_EQ(ProblemsOf((mode + "5}]}").c_str()), "");
  EXPECT_THAT(ProblemsOf((mode + "7}]}").c_str()), HasSubstr("values[0].arrived"));
  const std::string count = head + R"("statistic": "outcome_count", "outcomes": ["jammed"],
    "arrived": 5}]})";
  EXPECT_THAT(ProblemsOf(count.c_str()), HasSubstr("values[0].arrived"));
}

// Every number of table 4 and figure 17 was printed for 40 runs of which 39 arrived.
TEST(Reference, TheFortyRunsOfNominalTerrainHaveTheirArrivals) {
  int split = 0;
  for (const auto& value : Matthies().values) {
    const bool of_forty = value.scenario == "nominal" && value.sample_size == 40 &&
                          statistics::SplitsByArrival(value.statistic);
    EXPECT_EQ(value.arrived, of_forty ? 39 : 0) << value.id;
    split += of_forty ? 1 : 0;
  }
  EXPECT_EQ(split, 13);
  const std::string text = ComparisonText(Matthies(), CompareSynthetic());
  EXPECT_THAT(text, HasSubstr("      39 arrivals of 40"));
  EXPECT_THAT(text, testing::ContainsRegex("39 arrivals of 40 +[0-9]+ \\([0-9]+ \\.\\. [0-9]+\\)"))
      << "counts are whole";
}

TEST(ComparisonText, FitsAHundredColumnsAndNamesEveryValue) {
  const PublishedReference reference = Matthies();
  const std::string text = ComparisonText(reference, CompareSynthetic());
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line)) EXPECT_LE(line.size(), 100u) << line;
  for (const auto& value : reference.values) EXPECT_THAT(text, HasSubstr(value.what));
  EXPECT_THAT(text, core::Says("39/40", "no run of level_sand"));
}

// A difference that one layout for all runs of the set could make is none for certain.
TEST(ComparisonText, SaysWhereADifferenceRestsOnIndependentLayouts) {
  const auto text = [](statistics::Verdict verdict, double highest) {
    ComparisonResult result = CompareSynthetic();
    result.values[0].verdict = verdict;
    result.values[0].level = 0.01;
    result.values[0].one_layout = {{2e-4, highest}, false};
    // Without the ends of lines.
    std::istringstream words(ComparisonText(Matthies(), result));
    std::string line;
    for (std::string word; words >> word;) line += word + " ";
    return line;
  };
  const auto said = HasSubstr("if they all met one, this says nothing");
  EXPECT_THAT(text(Verdict::kDiffers, 1.0), said);
  EXPECT_THAT(text(Verdict::kDiffers, 0.009), testing::Not(said));
  EXPECT_THAT(text(Verdict::kUnderpowered, 1.0), testing::Not(said));
}

TEST(ComparisonCsv, HasTheSameNumberOfFieldsInEveryLine) {
  std::istringstream lines(ComparisonCsv(CompareSynthetic()));
  std::string line;
  while (std::getline(lines, line)) {
    bool quoted = false;
    std::size_t fields = 1;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (c == ',' && !quoted) ++fields;
    }
    EXPECT_EQ(fields, 22u) << line;
  }
}

TEST(ComparisonJUnit, CountsVerdictsAndEscapes) {
  ComparisonResult result = CompareSynthetic();
  result.values[0].verdict = Verdict::kDiffers;
  result.values[0].remark = "a < b & \"c\"";
  for (std::size_t i = 1; i < result.values.size(); ++i) {
    result.values[i].verdict = Verdict::kAgrees;
  }
  const std::string xml = ComparisonJUnit(Matthies(), result);
  EXPECT_THAT(
      xml, core::Says("tests=\"29\" failures=\"1\" skipped=\"0\"", "a &lt; b &amp; &quot;c&quot;",
                      "<testcase classname=\"nominal\" name=\"nominal.success\"/>"));
}

// A misspelt name or a moved file would take the warning away without a word.
TEST(Reference, NamesTheFileOfEveryScenario) {
  const std::filesystem::path folder = ROCKYARD_SOURCE_DIR "/results/reference";
  for (const char* file :
       {"matthies1995.json", "matthies1995_hazard_detection.json", "matthies1995_mission.json",
        "goldberg2002.json", "goldberg2002_stereo.json", "howard2012.json",
        "howard2012_odometry.json", "howard2012_speed.json"}) {
    const PublishedReference reference = LoadReference(folder / file);
    std::set<std::string> named;
    for (const auto& scenario : reference.scenarios) {
      named.insert(scenario.name);
      const core::JsonValue document = core::LoadJsonFile(folder / scenario.file);
      ASSERT_NE(document.Find("name"), nullptr) << scenario.file;
      EXPECT_EQ(document.Find("name")->text(), scenario.name);
    }
    for (const auto& value : reference.values) {
      EXPECT_TRUE(value.scenario.empty() || named.contains(value.scenario)) << value.id;
    }
  }
  EXPECT_THAT(ProblemsOf(R"({"schema_version": 1, "scenarios": [{"name": "a"}]})"),
              HasSubstr("scenarios[0].file"));
}

// Of the scenario alone that was run with other settings.
TEST(Comparison, OtherSettingsStandWhereRowsAreRead) {
  const auto records = statistics::SyntheticTrials({}, 3, 300);
  std::vector<statistics::ScenarioRun> runs = {RunOf("nominal", records),
                                               RunOf("obstacles_0.28", records)};
  runs[0].other_settings = {"k is 1, 2 in " + std::string(120, 'x') + " y"};
  const ComparisonResult result = statistics::Compare(Matthies(), runs, {.replicates = 100});
  ASSERT_NE(result.FindChanged("nominal"), nullptr);
  EXPECT_EQ(result.FindChanged("obstacles_0.28"), nullptr);
  EXPECT_THAT(ComparisonText(Matthies(), result), HasSubstr("nominal\n  NOT the published case"));
  EXPECT_THAT(ComparisonJUnit(Matthies(), result), HasSubstr("<property name=\"nominal: NOT"));
  std::istringstream lines(ComparisonCsv(result));
  for (std::string line; std::getline(lines, line);) {
    const bool nominal = line.starts_with("nominal.") && line.find('/') == std::string::npos;
    const bool told = line.find("NOT the published case") != std::string::npos;
    EXPECT_TRUE(told || !nominal) << line;
    EXPECT_FALSE(told && line.starts_with("obstacles_")) << line;
  }
}

TEST(Comparison, IsAPureFunctionOfItsArguments) {
  EXPECT_EQ(ComparisonCsv(CompareSynthetic()), ComparisonCsv(CompareSynthetic()));
}

}  // namespace
}  // namespace rockyard::report
