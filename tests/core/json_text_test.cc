#include "core/json_text.h"

#include <gmock/gmock.h>

#include <array>

#include "core/error.h"
#include "core/json_pieces.h"
#include "core/json_value.h"

namespace rockyard::core {
namespace {

using testing::HasSubstr;

Problem ProblemOf(std::string_view text, const JsonLimits& limits = {}) {
  try {
    ParseJson(text, "file.json", limits);
  } catch (const UserError& error) {
    EXPECT_EQ(error.problems().size(), 1u);
    return error.problems().front();
  }
  return {};
}

TEST(JsonTextTest, ParsesAllTypesInOrder) {
  const JsonValue value = ParseJson(
      R"({"z": null, "a": true, "i": -3, "r": 2.5, "t": "é\n", "l": [1, [2]], "o": {}})", "test");
  EXPECT_EQ(value.members().front().key, "z");
  EXPECT_TRUE(value.Find("z")->Is(JsonValue::Type::kNull));
  EXPECT_TRUE(value.Find("a")->boolean());
  EXPECT_EQ(value.Find("i")->integer(), -3);
  EXPECT_EQ(value.Find("r")->number(), 2.5);
  EXPECT_EQ(value.Find("t")->text(), "é\n");
  EXPECT_EQ(value.Find("l")->list()[1].list()[0].integer(), 2);
  EXPECT_TRUE(value.Find("o")->members().empty());
  EXPECT_EQ(value.Find("none"), nullptr);
}

TEST(JsonTextTest, ErrorsNameLineAndColumn) {
  const Problem problem = ProblemOf("{\n  \"a\": 1,\n  \"b\": }\n}");
  EXPECT_EQ(problem.path, "file.json");
  EXPECT_THAT(problem.reason, HasSubstr("line 3, column 8"));
  EXPECT_THAT(problem.suggestion, HasSubstr("strict JSON"));
}

TEST(JsonTextTest, MalformedTextsAreRefused) {
  for (const std::string_view text : {"",
                                      " ",
                                      "{",
                                      "[1, 2",
                                      "{\"a\": 1,}",
                                      "{'a': 1}",
                                      "{\"a\" 1}",
                                      "{\"a\": 1} x",
                                      "{\"a\": NaN}",
                                      "{\"a\": Infinity}",
                                      "{\"a\": -Infinity}",
                                      "{\"a\": 0x10}",
                                      "{\"a\": 01}",
                                      "{\"a\": +1}",
                                      "{\"a\": .5}",
                                      "{\"a\": 1.}",
                                      "// comment\n{}",
                                      "{\"a\": \"\x01\"}",
                                      "{\"a\": \"\xff\"}",
                                      "{\"a\": \"unfinished",
                                      "\"\\ud800\"",
                                      "tru"}) {
    const Problem problem = ProblemOf(text);
    EXPECT_THAT(problem.reason, HasSubstr("line 1")) << text;
    EXPECT_FALSE(problem.suggestion.empty()) << text;
  }
}

TEST(JsonTextTest, AnEmptyKeyIsNamed) {
  EXPECT_THAT(ProblemOf(R"({"": 1, "": 2})").path, testing::EndsWith(": \"\""));
  EXPECT_THAT(ProblemOf(R"({"": {"b": 1, "b": 2}})").path, testing::EndsWith(": \"\".b"));
}

TEST(JsonTextTest, NumbersBeyondADoubleAreRefused) {
  EXPECT_THAT(ProblemOf("{\"a\": 1e999}").reason, HasSubstr("number overflow parsing '1e999'"));
  EXPECT_THAT(ProblemOf("[-1e400]").reason, HasSubstr("overflow"));
}

TEST(JsonTextTest, IntegersBeyond64BitsBecomeReals) {
  EXPECT_EQ(ParseJson("9223372036854775807", "test").integer(),
            std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(ParseJson("9223372036854775808", "test").number(), 0x1.0p63);
  EXPECT_EQ(ParseJson("100000000000000000000000", "test").number(), 1e23);
}

TEST(JsonTextTest, DuplicateKeysAreErrorsWithTheirPath) {
  const Problem problem = ProblemOf("{\"a\": {\"b\": 1,\n \"c\": 2, \"b\": 3}}");
  EXPECT_EQ(problem.path, "file.json: a.b");
  EXPECT_THAT(problem.reason, HasSubstr("twice, again at line 2"));
  EXPECT_THAT(ProblemOf("[{}, {\"x\": 0, \"x\": 0}]").path, HasSubstr("1.x"));
  // The same key in different objects is fine.
  EXPECT_NO_THROW(ParseJson(R"({"a": {"b": 1}, "c": {"b": 1}})", "test"));
}

TEST(JsonTextTest, DeepNestingIsRefusedBeforeTheStackIs) {
  EXPECT_THAT(ProblemOf(std::string(1000000, '[')).reason, HasSubstr("nested deeper than 32"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  EXPECT_THAT(ProblemOf(objects).reason, HasSubstr("nested deeper than 32"));
  EXPECT_NO_THROW(ParseJson(std::string(32, '[') + std::string(32, ']'), "test"));
}

TEST(JsonTextTest, LargeTextsAreRefused) {
  EXPECT_THAT(ProblemOf("[1, 2, 3]", {.max_bytes = 5, .max_depth = 3}).reason,
              HasSubstr("has 9 bytes, more than the 5 allowed"));
}

TEST(JsonTextTest, DumpIsPrettyAndKeepsRealsReal) {
  const std::string text =
      "{\n  \"a\": 1.0,\n  \"b\": [1, 2.5],\n  \"c\": {\n    \"d\": \"x\\\"\"\n  },\n"
      "  \"e\": [],\n  \"f\": {},\n  \"g\": [\n    {\n      \"h\": null\n    }\n  ]\n}\n";
  EXPECT_EQ(DumpJson(ParseJson(text, "test")), text);
}

TEST(JsonTextTest, InvalidUtf8IsReplacedInOutput) {
  const std::string text = DumpJson(JsonValue(std::string("a\xff z")));
  EXPECT_NO_THROW(ParseJson(text, "test"));
}

TEST(JsonValueTest, MergeLaysObjectsOverEachOther) {
  JsonValue base = ParseJson(R"({"a": {"x": 1, "y": 2}, "b": [1, 2], "c": 3})", "test");
  base.Merge(ParseJson(R"({"a": {"y": 5, "z": 6}, "b": [9], "d": {}})", "test"));
  EXPECT_EQ(
      DumpJson(base),
      DumpJson(ParseJson(R"({"a": {"x": 1, "y": 5, "z": 6}, "b": [9], "c": 3, "d": {}})", "test")));
}

TEST(JsonValueTest, SetReplacesAppendsAndMakesObjects) {
  JsonValue value(1.0);
  value.Set("a", JsonValue(true));
  value.Set("b", JsonValue("x"));
  value.Set("a", JsonValue(false));
  EXPECT_EQ(value.members().size(), 2u);
  EXPECT_FALSE(value.Find("a")->boolean());
  value.Erase("a");
  value.Erase("none");
  EXPECT_EQ(value.members().size(), 1u);
}

// JSON text as result files and pages hold it.

JsonValue SampleDocument() {
  JsonValue json = JsonValue::Object({{"name", "x"}, {"count", 3}, {"none", JsonValue()}});
  json.Set("list", ListOf(std::vector<double>{1.0, 2.5}));
  json.Set("inner", JsonValue::Object({{"flag", true}, {"empty", JsonValue::Object()}}));
  return json;
}

TEST(SpreadJson, HasALineForEachValue) {
  EXPECT_EQ(SpreadJson(SampleDocument()),
            "{\n  \"name\": \"x\",\n  \"count\": 3,\n  \"none\": null,\n  \"list\": [\n    1.0,\n"
            "    2.5\n  ],\n  \"inner\": {\n    \"flag\": true,\n    \"empty\": {}\n  }\n}");
}

TEST(SpreadJson, KeepsWhatLiesDeeperTogether) {
  EXPECT_EQ(SpreadJson(SampleDocument(), 1),
            "{\n  \"name\": \"x\",\n  \"count\": 3,\n  \"none\": null,\n  \"list\": [1.0,2.5],\n"
            "  \"inner\": {\"flag\":true,\"empty\":{}}\n}");
  EXPECT_EQ(
      CompactJson(SampleDocument()),
      R"({"name":"x","count":3,"none":null,"list":[1.0,2.5],"inner":{"flag":true,"empty":{}}})");
}

TEST(SpreadJson, WritesWhatIsNotFiniteAsNull) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(CompactJson(ListOf(std::array{std::nan(""), infinity, -0.0})), "[null,null,-0.0]");
  EXPECT_EQ(CompactJson(ListOf(std::array{infinity, 1e15, 0.1}, NumberOrNull)), "[null,1e+15,0.1]");
}

// The two writers differ where they always have; both give the bits back.
TEST(SpreadJson, KeepsTheDigitsOfItsFiles) {
  const JsonValue number(0.38561059568280043);
  EXPECT_EQ(CompactJson(number), "0.38561059568280043");
  EXPECT_EQ(DumpJson(number), "0.3856105956828004\n");
  EXPECT_EQ(ParseJson(DumpJson(number), "test").number(), number.number());
}

TEST(QuoteJson, EscapesAndReplaces) {
  EXPECT_EQ(QuoteJson("plain"), "\"plain\"");
  EXPECT_EQ(QuoteJson("a\"\\\n\x01"), R"("a\"\\\n\u0001")");
  EXPECT_EQ(QuoteJson("\xc3\xa4"), "\"\xc3\xa4\"");
  EXPECT_EQ(QuoteJson("a\xff z"), "\"a\xef\xbf\xbd z\"");
}

TEST(JsonValueTest, UpdateSetsEveryMember) {
  JsonValue json = JsonValue::Object({{"a", 1}, {"b", 2}});
  json.Update(JsonValue::Object({{"b", "new"}, {"c", false}}));
  EXPECT_EQ(CompactJson(json), R"({"a":1,"b":"new","c":false})");
}

TEST(JsonPieces, NumbersHaveNoMoreThanTheyNeed) {
  EXPECT_EQ(JsonNumber(3.0), "3");
  EXPECT_EQ(JsonNumber(0.1), "0.1");
  EXPECT_EQ(JsonNumber(std::nan("")), "null");
  EXPECT_EQ(JsonSixDigits(1.0 / 3.0), "0.333333");
}

TEST(JsonPieces, AnObjectOfEverything) {
  const std::vector<std::string> texts{"x", "y"};
  EXPECT_EQ(
      JsonObject()
          .AddText("text", "a\"b")
          .AddNumber("number", 0.5)
          .AddInteger("integer", -2)
          .AddFlag("flag", true)
          .Add("texts", JsonTexts(texts))
          .Add("squares", JsonList(std::array{1, 2}, [](int i) { return std::to_string(i * i); }))
          .Text(),
      R"({"text":"a\"b","number":0.5,"integer":-2,"flag":true,"texts":["x","y"],)"
      R"("squares":[1,4]})");
  EXPECT_EQ(JsonObject().Text(), "{}");
}

}  // namespace
}  // namespace rockyard::core
