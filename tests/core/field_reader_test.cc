#include <cmath>

#include "core/archive.h"
#include "core/field_archive.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "core/test_params.h"
#include "core/text.h"

namespace rockyard::core {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TestParams Read(std::string_view json) {
  TestParams params;
  ReadParams(ParseJson(json, "test"), params);
  return params;
}

std::vector<Problem> ProblemsOf(std::string_view json) {
  return ProblemsIn([&] { Read(json); });
}

TEST(FieldReaderTest, MissingKeysKeepDefaults) {
  const TestParams params = Read("{}");
  EXPECT_EQ(params.radius_m, 0.5);
  EXPECT_EQ(params.inner.colour, Colour::kGreen);
}

TEST(FieldReaderTest, ReadsEveryKindOfField) {
  const TestParams params = Read(R"({
    "radius_m": 1, "heading_deg": 90, "count": 7.0, "enabled": false, "label": "x",
    "weights": [], "axes_m": [1, 0.5, 0], "stripes": [4], "inner": {"colour": "blue"}})");
  EXPECT_EQ(params.radius_m, 1.0);
  EXPECT_EQ(params.heading_rad, math::DegToRad(90.0));
  EXPECT_EQ(params.count, 7);
  EXPECT_FALSE(params.enabled);
  EXPECT_EQ(params.label, "x");
  EXPECT_THAT(params.weights, IsEmpty());
  EXPECT_THAT(params.axes_m, testing::ElementsAre(1.0, 0.5, 0.0));
  EXPECT_THAT(params.stripes, testing::ElementsAre(4));
  EXPECT_EQ(params.inner.colour, Colour::kBlue);
}

TEST(FieldReaderTest, BoundsAreInclusive) {
  EXPECT_EQ(Read(R"({"radius_m": 0.01})").radius_m, 0.01);
  EXPECT_EQ(Read(R"({"radius_m": 2})").radius_m, 2.0);
}

class BadInputTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, NamesPathReasonAndSuggestion) {
  EXPECT_THAT(ProblemsOf(GetParam().json), IsProblemOf(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(
    Inputs, BadInputTest,
    testing::Values(
        BadInput{"text_for_number", R"({"radius_m": "1"})", "radius_m",
                 "is \"1\" (a text), not a number", "write a number"},
        BadInput{"null", R"({"radius_m": null})", "radius_m", "is null, not a number", "number"},
        BadInput{"list_for_number", R"({"radius_m": [1]})", "radius_m", "is a list, not a number",
                 "number"},
        BadInput{"below", R"({"radius_m": -1})", "radius_m",
                 "is -1, below the smallest allowed value 0.01", "use a value from 0.01 to 2 m"},
        BadInput{"above", R"({"inner": {"low_m": 10.5}})", "inner.low_m",
                 "is 10.5, above the largest allowed value 10", "from 0 to 10 m"},
        BadInput{"huge", R"({"radius_m": 1e308})", "radius_m", "is 1e+308, above",
                 "from 0.01 to 2 m"},
        BadInput{"degrees", R"({"heading_deg": 181})", "heading_deg",
                 "above the largest allowed value 180", "from -180 to 180 deg"},
        BadInput{"fraction", R"({"count": 1.5})", "count", "is 1.5 (a number), not an integer",
                 "integer"},
        BadInput{"huge_integer", R"({"count": 1e300})", "count", "is 1e+300, above",
                 "from 0 to 1000"},
        BadInput{"number_for_boolean", R"({"enabled": 1})", "enabled",
                 "is 1 (an integer), not true or false", "true or false"},
        BadInput{"number_for_text", R"({"label": 1})", "label", "is 1 (an integer), not a text",
                 "a text"},
        BadInput{"enum", R"({"inner": {"colour": "blu"}})", "inner.colour",
                 "is \"blu\", which is not a known name",
                 "did you mean \"blue\"? one of: red, green, blue"},
        BadInput{"enum_type", R"({"inner": {"colour": 2}})", "inner.colour", "not a name",
                 "a name"},
        BadInput{"unknown_key", R"({"raduis_m": 1})", "raduis_m", "is not a known key",
                 "did you mean \"radius_m\"? one of: radius_m, heading_deg"},
        BadInput{"unknown_key_below", R"({"inner": {"color": "red"}})", "inner.color",
                 "is not a known key", "did you mean \"colour\"? one of: low_m, high_m, colour"},
        BadInput{"empty_key", R"({"": 1})", "\"\"", "is not a known key", "one of: radius_m"},
        BadInput{"empty_key_below", R"({"inner": {"": 1}})", "inner.\"\"", "is not a known key",
                 "one of: low_m, high_m, colour"},
        BadInput{"key_of_other_group", R"({"low_m": 1})", "low_m", "is not a known key",
                 "one of: radius_m"},
        BadInput{"list_element", R"({"weights": [1, "a"]})", "weights[1]",
                 "is \"a\" (a text), not a number", "a number"},
        BadInput{"list_element_bounds", R"({"stripes": [0, 5]})", "stripes[1]",
                 "above the largest allowed value 4", "from 0 to 4"},
        BadInput{"number_for_list", R"({"weights": 1})", "weights",
                 "is 1 (an integer), not a list of numbers", "a list of numbers"},
        BadInput{"list_length", R"({"axes_m": [1, 1]})", "axes_m", "has 2 elements, not 3",
                 "write 3 numbers"},
        BadInput{"group_type", R"({"inner": 3})", "inner", "is 3 (an integer), not an object",
                 "an object"},
        BadInput{"contradiction", R"({"inner": {"low_m": 3, "high_m": 2}})", "inner.high_m",
                 "is below low_m", "use a larger high_m"},
        BadInput{"contradicts_default", R"({"inner": {"low_m": 3}})", "inner.high_m",
                 "is below low_m", "use a larger high_m"},
        BadInput{"root", R"([1])", "(root)", "is a list, not an object", "an object"}),
    [](const auto& tested) { return std::string(tested.param.label); });

TEST(FieldReaderTest, ReportsEverythingAtOnce) {
  const auto problems = ProblemsOf(
      R"({"radius_m": -1, "count": "x", "typo": 1, "inner": {"colour": "pink", "more": 2}})");
  std::vector<std::string> paths;
  for (const Problem& problem : problems) paths.push_back(problem.path);
  EXPECT_THAT(paths, testing::UnorderedElementsAre("radius_m", "count", "typo", "inner.colour",
                                                   "inner.more"));
}

TEST(FieldReaderTest, ConditionsAreNotJudgedWhereAFieldCouldNotBeRead) {
  // With the default high_m of 1 the condition would fail, but it is high_m that is wrong.
  EXPECT_THAT(ProblemsOf(R"({"inner": {"low_m": 3, "high_m": "x"}})"),
              OneProblem("inner.high_m", "not a number"));
}

TEST(FieldReaderTest, AFieldWithAProblemKeepsItsValue) {
  TestParams params;
  const JsonValue json = ParseJson(R"({"radius_m": 99, "weights": [1, -1], "count": 9})", "test");
  EXPECT_THROW(ReadParams(json, params), UserError);
  EXPECT_EQ(params.radius_m, 0.5);
  EXPECT_THAT(params.weights, testing::ElementsAre(1.0, 2.5));
  EXPECT_EQ(params.count, 9);
}

TEST(FieldReaderTest, LongListsAndTextsAreRefused) {
  std::string list = "[0";
  for (int i = 0; i < 1000; ++i) list += ",0";
  const auto problems =
      ProblemsOf("{\"weights\": " + list + "], \"label\": \"" + std::string(10001, 'a') + "\"}");
  ASSERT_THAT(problems, SizeIs(2));
  EXPECT_EQ(problems[0].path, "label");
  EXPECT_EQ(problems[1].path, "weights");
  EXPECT_THAT(problems[1].reason, HasSubstr("has 1001 elements"));
}

TEST(FieldReaderTest, TheListOfProblemsIsCut) {
  std::string json = "{";
  for (int i = 0; i < 5000; ++i) json += "\"unknown" + std::to_string(i) + "\": 0,";
  json += "\"count\": 1}";
  const auto problems = ProblemsOf(json);
  ASSERT_THAT(problems, SizeIs(101));
  EXPECT_EQ(problems.back().reason, "4900 more problems");
}

TEST(FieldReaderTest, LongKeysAreCutInMessages) {
  const auto problems = ProblemsOf("{\"" + std::string(100000, 'k') + "\": 1}");
  ASSERT_THAT(problems, SizeIs(1));
  EXPECT_LT(problems[0].path.size(), 100u);
}

// What is told about parameters: tables and schemas.

TEST(FieldTableTest, ListsEveryFieldInOrderWithItsPath) {
  const FieldTable table = ListParams<TestParams>();
  std::vector<std::string> paths;
  for (const ParameterInfo& parameter : table.parameters()) paths.push_back(parameter.path);
  EXPECT_THAT(paths, testing::ElementsAre("radius_m", "heading_deg", "count", "enabled", "label",
                                          "weights", "axes_m", "stripes", "unbounded",
                                          "inner.low_m", "inner.high_m", "inner.colour"));
}

TEST(FieldTableTest, TellsAllThatIsKnown) {
  const FieldTable table = ListParams<TestParams>();
  const ParameterInfo& radius = table.parameters()[0];
  EXPECT_EQ(radius.value.number(), 0.5);
  EXPECT_EQ(radius.unit, "m");
  EXPECT_EQ(radius.min, 0.01);
  EXPECT_EQ(radius.max, 2.0);
  EXPECT_EQ(Name(radius.origin), "published");
  EXPECT_EQ(radius.source, "Author 1995 sec. 1");
  EXPECT_TRUE(radius.HasStudyRange());
  const ParameterInfo& heading = table.parameters()[1];
  EXPECT_EQ(heading.value.number(), 30.0);  // degrees
  EXPECT_FALSE(heading.HasStudyRange());
  EXPECT_THAT(table.parameters().back().choices, testing::ElementsAre("red", "green", "blue"));
  EXPECT_TRUE(std::isinf(table.parameters()[8].max));
}

TEST(FieldSchemaTest, DescribesFieldsAndGroups) {
  const JsonValue schema = SchemaOf<TestParams>("test");
  EXPECT_EQ(schema.Find("$schema")->text(), "https://json-schema.org/draft/2020-12/schema");
  EXPECT_FALSE(schema.Find("additionalProperties")->boolean());
  const JsonValue& properties = *schema.Find("properties");
  EXPECT_EQ(properties.members().front().key, "radius_m");  // in visiting order
  EXPECT_EQ(properties.members().back().key, "inner");
  const JsonValue& radius = *properties.Find("radius_m");
  EXPECT_EQ(radius.Find("type")->text(), "number");
  EXPECT_EQ(radius.Find("minimum")->number(), 0.01);
  EXPECT_EQ(radius.Find("maximum")->number(), 2.0);
  EXPECT_EQ(radius.Find("default")->number(), 0.5);
  EXPECT_EQ(radius.Find("x-unit")->text(), "m");
  EXPECT_EQ(radius.Find("x-study-range")->list().size(), 2u);
  EXPECT_EQ(properties.Find("unbounded")->Find("minimum"), nullptr);
  const JsonValue& axes = *properties.Find("axes_m");
  EXPECT_EQ(axes.Find("minItems")->integer(), 3);
  EXPECT_EQ(axes.Find("items")->Find("maximum")->number(), 1.0);
  const JsonValue& colour = *properties.Find("inner")->Find("properties")->Find("colour");
  EXPECT_EQ(colour.Find("enum")->list().size(), 3u);
  EXPECT_EQ(colour.Find("default")->text(), "green");
}

TEST(FieldSchemaTest, IsJson) {
  EXPECT_NO_THROW(ParseJson(DumpJson(SchemaOf<TestParams>("test")), "schema"));
}

TEST(SpellingTest, EditDistanceOfKnownPairs) {
  EXPECT_EQ(EditDistance("", ""), 0u);
  EXPECT_EQ(EditDistance("", "abc"), 3u);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(EditDistance("trials", "trails"), 1u);  // neighbours swapped
  EXPECT_EQ(EditDistance("saturday", "sunday"), 3u);
}

TEST(SpellingTest, NearestFindsTheClosestCandidateOnly) {
  constexpr std::array<std::string_view, 3> kNames = {"seed", "trials", "terrain"};
  EXPECT_EQ(Nearest("trails", kNames), "trials");
  EXPECT_EQ(Nearest("sed", kNames), "seed");
  EXPECT_EQ(Nearest("completely_else", kNames), "");
  EXPECT_EQ(Nearest(std::string(100000, 'x'), kNames), "");
}

TEST(SpellingTest, SuggestionListsEverything) {
  constexpr std::array<std::string_view, 2> kNames = {"open", "walled"};
  EXPECT_EQ(Suggest("waled", kNames), "did you mean \"walled\"? one of: open, walled");
  EXPECT_EQ(Suggest("zzzzzzzz", kNames), "one of: open, walled");
  EXPECT_EQ(Suggest("opn", std::span(kNames).first(1)), "did you mean \"open\"?");
  EXPECT_EQ(Suggest("x", {}), "");
}

}  // namespace
}  // namespace rockyard::core
