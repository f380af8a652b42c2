#include "core/json_text.h"

#include <gmock/gmock.h>

#include <limits>
#include <string>

#include "core/error.h"

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

}  // namespace
}  // namespace rockyard::core
