// What a navigator says of itself: parameters of every type, own values and traits, as plugins and
// processes write them; and what is refused.
#include "plugin/description.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <bit>
#include <string>

#include "core/archive.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "math/angles.h"

namespace rockyard::plugin {
namespace {

using core::FieldKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::unique_ptr<const Description> Read(const std::string& json) {
  return ReadDescription(core::ParseJson(json, "test"), "mine.so");
}

// A description with these parameters.
std::unique_ptr<const Description> WithParameters(const std::string& parameters) {
  return Read(R"({"name": "mine", "parameters": [)" + parameters + "]}");
}

std::string RefusalOfParameters(const std::string& parameters) {
  return core::RefusalOf([&] { WithParameters(parameters); });
}

constexpr const char* kEveryType = R"(
  {"name": "real", "type": "real", "default": 1.5, "min": -2, "max": 2.5, "doc": "a number",
   "source": "a guess", "origin": "assumed", "study": [1, 2]},
  {"name": "angle_deg", "type": "angle", "default": 0.5, "max": 180, "origin": "published"},
  {"name": "integer", "type": "integer", "default": -7, "origin": "calibrated"},
  {"name": "boolean", "type": "boolean", "default": true},
  {"name": "text", "type": "text", "default": "höher"},
  {"name": "reals", "type": "reals", "default": [1.5, 2], "max_entries": 3},
  {"name": "fixed", "type": "fixed_reals", "default": [3.5, 4.5]},
  {"name": "integers", "type": "integers", "default": [9007199254740993, -6]},
  {"name": "choice", "type": "choice", "choices": ["first", "second", "third"], "default": 1},
  {"name": "outer", "type": "group", "doc": "a group", "parameters": [
    {"name": "low", "type": "real", "default": 3},
    {"name": "inner", "type": "group", "parameters": [
      {"name": "deep", "type": "choice", "choices": ["a", "b"], "default": "b"}]}]},
  {"name": "last", "type": "real", "default": 8.5})";

// The defaults as a scenario has them.
constexpr const char* kDefaults = R"({"real":1.5,"angle_deg":28.64788975654116,"integer":-7,)"
                                  R"("boolean":true,"text":"höher","reals":[1.5,2.0],)"
                                  R"("fixed":[3.5,4.5],"integers":[9007199254740993,-6],)"
                                  R"("choice":"second","outer":{"low":3.0,"inner":{"deep":"b"}},)"
                                  R"("last":8.5})";

TEST(DescriptionTest, HasAParameterOfEachType) {
  const auto description = WithParameters(kEveryType);
  core::FieldTable table = core::ListParams(Parameters(*description));
  const auto& known = table.parameters();
  ASSERT_EQ(known.size(), 12U);
  const FieldKind kKinds[] = {FieldKind::kReal,    FieldKind::kAngle,    FieldKind::kInteger,
                              FieldKind::kBoolean, FieldKind::kText,     FieldKind::kReals,
                              FieldKind::kReals,   FieldKind::kIntegers, FieldKind::kChoice,
                              FieldKind::kReal,    FieldKind::kChoice,   FieldKind::kReal};
  for (std::size_t i = 0; i < known.size(); ++i) EXPECT_EQ(known[i].kind, kKinds[i]) << i;
  EXPECT_EQ(known[0].doc, "a number");
  EXPECT_EQ(known[0].source, "a guess");
  EXPECT_EQ(known[0].origin, core::Origin::kAssumed);
  EXPECT_EQ(known[0].min, -2.0);
  EXPECT_EQ(known[0].max, 2.5);
  EXPECT_EQ(known[0].study_low, 1.0);
  EXPECT_EQ(known[0].study_high, 2.0);
  EXPECT_EQ(known[1].origin, core::Origin::kPublished);
  EXPECT_EQ(known[1].min, -core::kUnbounded);
  EXPECT_EQ(known[1].max, 180.0);
  EXPECT_EQ(known[2].origin, core::Origin::kCalibrated);
  EXPECT_EQ(known[3].origin, core::Origin::kSetting);
  EXPECT_FALSE(known[3].HasStudyRange());
  EXPECT_EQ(known[6].fixed_length, 2U);
  EXPECT_THAT(known[8].choices, ElementsAre("first", "second", "third"));
  EXPECT_EQ(known[9].path, "outer.low");
  EXPECT_EQ(known[10].path, "outer.inner.deep");
  EXPECT_EQ(known[11].path, "last");
  EXPECT_EQ(core::CompactJson(core::WriteParams(Parameters(*description))), kDefaults);
}

TEST(DescriptionTest, WhatIsLeftOutHasADefault) {
  const auto description = Read(R"({"name": "mine"})");
  EXPECT_EQ(description->name, "mine");
  EXPECT_EQ(description->doc, "of a plugin");
  EXPECT_EQ(description->version, "");
  EXPECT_THAT(description->fields, IsEmpty());
  EXPECT_THAT(description->own_values, IsEmpty());
  const auto one = WithParameters(R"({"name": "x", "type": "choice", "choices": ["a", "b"]},
                                     {"name": "y", "type": "boolean"})");
  EXPECT_EQ(core::CompactJson(Parameters(*one).ToJson()), R"({"x":"a","y":false})");
}

TEST(DescriptionTest, OwnValuesKeepTheirOrder) {
  const auto description =
      Read(R"({"name": "mine", "doc": "drives", "version": "1.5", "own_values": [
        {"name": "replans", "unit": "1", "meaning": "how often"}, {"name": "b2"}]})");
  EXPECT_EQ(description->doc, "drives");
  EXPECT_EQ(description->version, "1.5");
  ASSERT_EQ(description->own_values.size(), 2U);
  EXPECT_EQ(description->own_values[0].meaning, "how often");
  EXPECT_EQ(description->own_values[1].name, "b2");
  EXPECT_EQ(description->own_values[1].unit, "1");
}

// What a reader sets is written and handed over; what it leaves out keeps its default.
TEST(ParametersTest, ReadWhatTheyWrite) {
  const auto description = WithParameters(kEveryType);
  constexpr const char* kSet =
      R"({"real":-0.1,"angle_deg":90.0,"integer":9,"boolean":false,"text":"","reals":[],)"
      R"("fixed":[0.1,0.2],"integers":[1],"choice":"third",)"
      R"("outer":{"low":-1.0,"inner":{"deep":"a"}},"last":1e-300})";
  Parameters parameters(*description);
  core::ReadParams(core::ParseJson(kSet, "test"), parameters);
  EXPECT_EQ(core::CompactJson(core::WriteParams(parameters)), kSet);
  ASSERT_EQ(parameters.values().size(), 12U);
  EXPECT_EQ(parameters.values()[1].real, math::DegToRad(90.0));
  EXPECT_EQ(parameters.values()[8].choice, 2);
  EXPECT_EQ(parameters.values()[11].real, 1e-300);
  // A copy is another set of values.
  Parameters copy = parameters;
  core::ReadParams(core::ParseJson(R"({"outer": {"low": 4}})", "test"), copy);
  EXPECT_EQ(copy.values()[9].real, 4.0);
  EXPECT_EQ(parameters.values()[9].real, -1.0);
}

// A process gets values by name: angles in rad, as all its messages have them.
TEST(ParametersTest, OfAProcessAreNamed) {
  const auto description = WithParameters(kEveryType);
  EXPECT_EQ(core::CompactJson(Parameters(*description).ToJson()),
            R"({"real":1.5,"angle_deg":0.5,"integer":-7,"boolean":true,"text":"höher",)"
            R"("reals":[1.5,2.0],"fixed":[3.5,4.5],"integers":[9007199254740993,-6],)"
            R"("choice":"second","outer":{"low":3.0,"inner":{"deep":"b"}},"last":8.5})");
}

TEST(ParametersTest, BoundsAndNamesAreHeldTo) {
  const auto description = WithParameters(kEveryType);
  const auto problems = [&](const char* json) {
    Parameters parameters(*description);
    return core::ProblemsIn([&] { core::ReadParams(core::ParseJson(json, "test"), parameters); });
  };
  EXPECT_THAT(problems(R"({"real": 2.6})"), core::OneProblem("real", "above", "from -2 to 2.5"));
  EXPECT_THAT(problems(R"({"angle_deg": 181})"), core::OneProblem("angle_deg", "above"));
  EXPECT_THAT(problems(R"({"reals": [1, 2, 3, 4]})"), core::OneProblem("reals", "4", "3"));
  EXPECT_THAT(problems(R"({"fixed": [1]})"), core::OneProblem("fixed", "", "2"));
  EXPECT_THAT(problems(R"({"choice": "scond"})"), core::OneProblem("choice", "", "second"));
  EXPECT_THAT(problems(R"({"outer": {"inner": {"dep": "a"}}})"),
              core::OneProblem("outer.inner.dep", "not a known key", "deep"));
  EXPECT_THAT(problems(R"({"integer": 1.5})"), core::OneProblem("integer", "integer"));
}

struct Wrong {
  const char* label;
  const char* parameter;
  const char* words;
};

void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.label; }

class WrongParameter : public testing::TestWithParam<Wrong> {};

INSTANTIATE_TEST_SUITE_P(
    Ways, WrongParameter,
    testing::Values(
        Wrong{"NoObject", R"(3)", "parameters[0] is no object"},
        Wrong{"NoName", R"({"type": "real", "default": 1})", "parameters[0].name is no text"},
        Wrong{"NameIsNone", R"({"name": "a.b", "type": "real", "default": 1})",
              "name has characters other than"},
        Wrong{"NameIsEmpty", R"({"name": "", "type": "real", "default": 1})",
              "name has characters other than"},
        Wrong{"NoType", R"({"name": "x", "default": 1})", "type is no text"},
        Wrong{"UnknownType", R"({"name": "x", "type": "rael", "default": 1})",
              "type is \"rael\"; did you mean \"real\"?"},
        Wrong{"NoDefault", R"({"name": "x", "type": "real"})", "default is no number"},
        Wrong{"TextForReal", R"({"name": "x", "type": "real", "default": "1"})",
              "default is no number"},
        Wrong{"NullForAngle", R"({"name": "x", "type": "angle", "default": null})",
              "default is no number"},
        Wrong{"RealForInteger", R"({"name": "x", "type": "integer", "default": 1.5})",
              "default is no integer"},
        Wrong{"NumberForBoolean", R"({"name": "x", "type": "boolean", "default": 1})",
              "default is neither true nor false"},
        Wrong{"NumberForText", R"({"name": "x", "type": "text", "default": 1})",
              "default is no text"},
        Wrong{"NumberForReals", R"({"name": "x", "type": "reals", "default": 1})",
              "default is no list"},
        Wrong{"TextInReals", R"({"name": "x", "type": "fixed_reals", "default": [1, "2"]})",
              "default is no list of numbers"},
        Wrong{"RealInIntegers", R"({"name": "x", "type": "integers", "default": [1, 2.5]})",
              "default is no list of integers"},
        Wrong{"NoChoices", R"({"name": "x", "type": "choice", "default": 0})",
              "choices is no list of names"},
        Wrong{"EmptyChoices", R"({"name": "x", "type": "choice", "choices": [], "default": 0})",
              "choices is no list of names"},
        Wrong{"ChoiceBeyond",
              R"({"name": "x", "type": "choice", "choices": ["a", "b"], "default": 2})",
              "default is none of the choices"},
        Wrong{"ChoiceBelow",
              R"({"name": "x", "type": "choice", "choices": ["a", "b"], "default": -1})",
              "default is none of the choices"},
        Wrong{"ChoiceBetween",
              R"({"name": "x", "type": "choice", "choices": ["a", "b"], "default": 0.5})",
              "default is none of the choices"},
        Wrong{"ChoiceUnknown",
              R"({"name": "x", "type": "choice", "choices": ["a", "b"], "default": "c"})",
              "default is none of the choices"},
        Wrong{"BoundsCrossed", R"({"name": "x", "type": "real", "default": 1, "min": 2, "max": 1})",
              "min is above max"},
        Wrong{"BoundIsText", R"({"name": "x", "type": "real", "default": 1, "min": "0"})",
              "min is no number"},
        Wrong{"StudyOfOne", R"({"name": "x", "type": "real", "default": 1, "study": [1]})",
              "study is no pair of numbers"},
        Wrong{"UnknownOrigin", R"({"name": "x", "type": "real", "default": 1, "origin": "guess"})",
              "origin is \"guess\""},
        Wrong{"TwiceTheName",
              R"({"name": "x", "type": "real", "default": 1},
                 {"name": "x", "type": "text", "default": ""})",
              "parameters[1].name is there twice"},
        Wrong{"TwiceInAGroup",
              R"({"name": "g", "type": "group", "parameters": [
                   {"name": "x", "type": "real", "default": 1},
                   {"name": "x", "type": "real", "default": 1}]})",
              "parameters[0].parameters[1].name is there twice"},
        Wrong{"GroupOfNumbers", R"({"name": "g", "type": "group", "parameters": [1]})",
              "parameters[0].parameters[0] is no object"}),
    [](const auto& way) { return std::string(way.param.label); });

TEST_P(WrongParameter, IsRefusedWithItsPlace) {
  EXPECT_THAT(RefusalOfParameters(GetParam().parameter),
              testing::AllOf(testing::StartsWith("mine.so"), HasSubstr("description."),
                             HasSubstr(GetParam().words)));
}

// The same name may stand in two groups.
TEST(DescriptionTest, NamesAreOfAGroup) {
  EXPECT_EQ(RefusalOfParameters(R"({"name": "x", "type": "real", "default": 1},
                                   {"name": "g", "type": "group", "parameters": [
                                     {"name": "x", "type": "real", "default": 1}]})"),
            "");
}

TEST(DescriptionTest, GroupsAreNotTooDeepNorParametersTooMany) {
  const auto nested = [](int groups) {
    std::string text = R"({"name": "x", "type": "real", "default": 1})";
    for (int i = 0; i < groups; ++i) {
      text = fmt::format(R"({{"name": "g{}", "type": "group", "parameters": [{}]}})", i, text);
    }
    return text;
  };
  EXPECT_EQ(RefusalOfParameters(nested(4)), "");
  EXPECT_THAT(RefusalOfParameters(nested(5)), HasSubstr("too many groups"));

  const auto many = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      text +=
          fmt::format(R"({}{{"name": "x{}", "type": "real", "default": 1}})", i == 0 ? "" : ",", i);
    }
    return text;
  };
  EXPECT_EQ(RefusalOfParameters(many(1000)), "");
  EXPECT_THAT(RefusalOfParameters(many(1001)), HasSubstr("more than 1000"));
  // Those in groups count as well.
  EXPECT_THAT(RefusalOfParameters(R"({"name": "g", "type": "group", "parameters": [)" + many(600) +
                                  R"(]}, {"name": "h", "type": "group", "parameters": [)" +
                                  many(600) + "]}"),
              HasSubstr("more than 1000"));
}

TEST(DescriptionTest, OfAnotherShapeIsRefused) {
  const auto refusal = [](const char* json) { return core::RefusalOf([&] { Read(json); }); };
  EXPECT_THAT(refusal("[]"), HasSubstr("description is no object"));
  EXPECT_THAT(refusal("{}"), HasSubstr("description.name is no text"));
  EXPECT_THAT(refusal(R"({"name": "mine", "doc": 1})"), HasSubstr("doc is no text"));
  EXPECT_THAT(refusal(R"({"name": "mine", "version": 2})"), HasSubstr("version is no text"));
  EXPECT_THAT(refusal(R"({"name": "mine", "parameters": {}})"), HasSubstr("parameters is no list"));
  EXPECT_THAT(refusal(R"({"name": "mine", "own_values": [{"name": "a b"}]})"),
              HasSubstr("own_values[0].name has characters"));
  EXPECT_THAT(refusal(R"({"name": "mine", "own_values": [{"name": "a"}, {"name": "a"}]})"),
              HasSubstr("own_values[1].name is there twice"));
}

Traits TraitsIn(const std::string& json) {
  return ReadTraits(core::ParseJson(json, "test"), "mine.so");
}

constexpr const char* kGoal = R"("goal_tolerance": {"parameter": "tolerance_m", "value_m": 0.25})";

TEST(TraitsTest, HoldWhatATrialHasToKnow) {
  const Traits least = TraitsIn(std::string(R"({"reads": "nothing", )") + kGoal + "}");
  EXPECT_EQ(least.reads, navigation::LookReading::kNothing);
  EXPECT_EQ(std::get<navigation::CostOfLook>(least.cost).time_s, 0.0);
  EXPECT_EQ(least.goal_parameter, "tolerance_m");
  EXPECT_EQ(least.goal_tolerance_m, 0.25);
  EXPECT_FALSE(least.looks_on_the_move || least.steers_on_the_move || least.images);
  EXPECT_THAT(least.problems, IsEmpty());

  const auto with = [](const std::string& more) {
    return TraitsIn(std::string(R"({"reads": "points", )") + kGoal + ", " + more + "}");
  };
  EXPECT_EQ(
      std::get<navigation::CostOfLook>(with(R"("cost": {"kind": "look", "time_s": 1.5})").cost)
          .time_s,
      1.5);
  const auto map = std::get<navigation::CostOfMap>(
      with(R"("cost": {"kind": "map", "cell_m": 0.5, "area_m2": 25})").cost);
  EXPECT_EQ(map.cell_m, 0.5);
  EXPECT_EQ(map.area_m2, 25.0);
  EXPECT_TRUE(std::holds_alternative<navigation::CostOfJudgement>(
      with(R"("cost": {"kind": "judgement"})").cost));
  EXPECT_TRUE(with(R"("looks_on_the_move": true)").looks_on_the_move);
  EXPECT_TRUE(with(R"("steers_on_the_move": true)").steers_on_the_move);
  EXPECT_TRUE(with(R"("images": true)").images);
  EXPECT_EQ(with(R"("looks_on_the_move": false)").reads, navigation::LookReading::kPoints);
  EXPECT_EQ(TraitsIn(std::string(R"({"reads": "hazards", )") + kGoal + "}").reads,
            navigation::LookReading::kHazardReport);
}

TEST(TraitsTest, AreThoseOfANavigator) {
  Traits traits = TraitsIn(std::string(R"({"reads": "points", "looks_on_the_move": true,
    "cost": {"kind": "judgement"}, )") +
                           kGoal + "}");
  const navigation::NavigatorTraits known = traits.AsNavigatorTraits();
  EXPECT_EQ(known.reads, navigation::LookReading::kPoints);
  EXPECT_TRUE(std::holds_alternative<navigation::CostOfJudgement>(known.cost));
  EXPECT_EQ(known.goal.path, "tolerance_m");
  EXPECT_EQ(known.goal.tolerance_m, 0.25);
  EXPECT_TRUE(known.looks_on_the_move);
  EXPECT_FALSE(known.steers_on_the_move);
  EXPECT_FALSE(known.follows_route);
  traits.steers_on_the_move = true;
  EXPECT_TRUE(traits.AsNavigatorTraits().steers_on_the_move);
  EXPECT_FALSE(traits.AsNavigatorTraits().images);
  traits.images = true;
  EXPECT_TRUE(traits.AsNavigatorTraits().images);
}

TEST(TraitsTest, TellProblemsOfParameters) {
  const Traits traits =
      TraitsIn(std::string(R"({"reads": "nothing", )") + kGoal + R"(, "problems": [
    {"parameter": "outer.low", "reason": "is too low", "suggestion": "use more"},
    {"parameter": "x", "reason": "is odd"}]})");
  ASSERT_EQ(traits.problems.size(), 2U);
  EXPECT_EQ(traits.problems[0].path, "outer.low");
  EXPECT_EQ(traits.problems[0].reason, "is too low");
  EXPECT_EQ(traits.problems[0].suggestion, "use more");
  EXPECT_EQ(traits.problems[1].suggestion, "");
}

TEST(TraitsTest, OfAnotherShapeAreRefused) {
  const auto refusal = [](const std::string& json) {
    return core::RefusalOf([&] { TraitsIn(json); });
  };
  const auto with = [&](const std::string& more) {
    return refusal(std::string(R"({"reads": "points", )") + kGoal + ", " + more + "}");
  };
  EXPECT_THAT(refusal(R"({"reads": "points"})"), HasSubstr("goal_tolerance is not there"));
  EXPECT_THAT(refusal(std::string("{") + kGoal + "}"), HasSubstr("reads is no text"));
  EXPECT_THAT(refusal(std::string(R"({"reads": "point", )") + kGoal + "}"),
              HasSubstr("did you mean \"points\"?"));
  EXPECT_THAT(refusal(R"({"reads": "points", "goal_tolerance": {"parameter": "x"}})"),
              HasSubstr("goal_tolerance.value_m is no number"));
  EXPECT_THAT(with(R"("cost": 3)"), HasSubstr("cost is no object"));
  EXPECT_THAT(with(R"("cost": {"kind": "lunch"})"), HasSubstr("none of look, map, judgement"));
  EXPECT_THAT(with(R"("cost": {"kind": "look", "time_s": -1})"), HasSubstr("time_s is below 0"));
  EXPECT_THAT(with(R"("cost": {"kind": "map", "cell_m": 0, "area_m2": 1})"),
              HasSubstr("not above 0"));
  EXPECT_THAT(with(R"("cost": {"kind": "map", "cell_m": 1})"), HasSubstr("area_m2 is no number"));
  EXPECT_THAT(with(R"("looks_on_the_move": 1)"), HasSubstr("neither true nor false"));
  EXPECT_THAT(with(R"("problems": [{"parameter": "x"}])"),
              HasSubstr("problems[0].reason is no text"));
}

}  // namespace
}  // namespace rockyard::plugin
