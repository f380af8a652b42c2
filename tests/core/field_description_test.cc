// What is told about parameters: tables and schemas.
#include <gmock/gmock.h>

#include <cmath>

#include "core/archive.h"
#include "core/json_text.h"
#include "core/test_params.h"

namespace rockyard::core {
namespace {

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

}  // namespace
}  // namespace rockyard::core
