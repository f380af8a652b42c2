// The committed numbers of hazard detection, and mistakes in such a file.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <string>

#include "core/json_text.h"
#include "core/refusals.h"
#include "report/comparison_reference.h"
#include "report/comparison_table.h"
#include "statistics/published_comparison.h"

namespace rockyard::report {
namespace {

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
  EXPECT_THAT(ComparisonText(reference, result), HasSubstr("; 28 of them computed, not simulated"));
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

}  // namespace
}  // namespace rockyard::report
