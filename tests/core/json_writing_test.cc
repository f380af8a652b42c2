// JSON text as result files and pages hold it.

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "core/json_pieces.h"
#include "core/json_text.h"
#include "core/json_value.h"

namespace rockyard::core {
namespace {

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
