// Rules that every parameter of every module keeps.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

using core::FieldKind;
using core::ParameterInfo;

bool IsNumber(const ParameterInfo& parameter) {
  return parameter.kind == FieldKind::kReal || parameter.kind == FieldKind::kAngle ||
         parameter.kind == FieldKind::kInteger;
}

TEST(ParametersTest, PathsAreUnique) {
  std::set<std::string> paths;
  for (const ParameterInfo& parameter : ListParameters()) {
    EXPECT_TRUE(paths.insert(parameter.path).second) << parameter.path;
  }
  EXPECT_GT(paths.size(), 80u);
}

TEST(ParametersTest, EveryParameterIsDescribedAndBounded) {
  for (const ParameterInfo& parameter : ListParameters()) {
    EXPECT_FALSE(parameter.doc.empty()) << parameter.path;
    if (IsNumber(parameter) || parameter.kind == FieldKind::kReals) {
      EXPECT_TRUE(std::isfinite(parameter.min) && std::isfinite(parameter.max)) << parameter.path;
      EXPECT_LE(parameter.min, parameter.max) << parameter.path;
    }
  }
}

TEST(ParametersTest, DefaultsAndStudyRangesAreWithinBounds) {
  for (const ParameterInfo& parameter : ListParameters()) {
    if (!IsNumber(parameter)) continue;
    EXPECT_GE(parameter.value.number(), parameter.min) << parameter.path;
    EXPECT_LE(parameter.value.number(), parameter.max) << parameter.path;
    if (parameter.HasStudyRange()) {
      EXPECT_GE(parameter.study_low, parameter.min) << parameter.path;
      EXPECT_LE(parameter.study_high, parameter.max) << parameter.path;
      EXPECT_GE(parameter.value.number(), parameter.study_low) << parameter.path;
      EXPECT_LE(parameter.value.number(), parameter.study_high) << parameter.path;
    }
  }
}

TEST(ParametersTest, PublishedValuesNameTheirSource) {
  for (const ParameterInfo& parameter : ListParameters()) {
    if (parameter.origin == core::Origin::kPublished ||
        parameter.origin == core::Origin::kCalibrated) {
      EXPECT_FALSE(parameter.source.empty()) << parameter.path;
    }
  }
}

// Radians only where a source states the value in them.
TEST(ParametersTest, AnglesAreInDegreesInJson) {
  for (const ParameterInfo& parameter : ListParameters()) {
    if (parameter.kind == FieldKind::kAngle) {
      EXPECT_TRUE(parameter.unit.starts_with("deg")) << parameter.path;
    } else if (parameter.unit.starts_with("rad")) {
      EXPECT_EQ(parameter.origin, core::Origin::kPublished) << parameter.path;
    }
  }
}

TEST(ParametersTest, EveryParameterCanBeSetByItsPath) {
  for (const ParameterInfo& parameter : ListParameters()) {
    core::JsonValue document = core::JsonValue::Object();
    core::SetPath(document, parameter.path, parameter.value);
    EXPECT_NO_THROW(ReadScenario(document)) << parameter.path;
  }
}

// Every number comes back as set, where no condition across fields refuses it.
TEST(ParametersTest, WhatIsSetIsRead) {
  const std::vector<ParameterInfo> defaults = ListParameters();
  std::size_t numbers = 0;
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < defaults.size(); ++i) {
    const ParameterInfo& parameter = defaults[i];
    if (!IsNumber(parameter)) continue;
    ++numbers;
    const double value = parameter.value.number();
    const bool integer = parameter.kind == FieldKind::kInteger;
    const double other = integer ? value + 1.0 : value + 0.01 * (parameter.max - value);
    core::JsonValue document = core::JsonValue::Object();
    core::SetPath(document, parameter.path, core::JsonValue(other));
    Scenario scenario;
    if (!core::ProblemsIn([&] { scenario = ReadScenario(document); }).empty()) continue;
    ++accepted;
    EXPECT_NEAR(ListParameters(scenario)[i].value.number(), other, 1e-12 * std::abs(other))
        << parameter.path;
  }
  EXPECT_GT(accepted, numbers * 3 / 4);
}

TEST(ParametersTest, TheSchemaDescribesEveryParameter) {
  const core::JsonValue schema = core::ParseJson(SchemaJson(), "schema");
  for (const ParameterInfo& parameter : ListParameters()) {
    const core::JsonValue* at = &schema;
    std::string_view rest = parameter.path;
    while (at != nullptr && !rest.empty()) {
      const std::size_t dot = rest.find('.');
      at = at->Find("properties") == nullptr ? nullptr
                                             : at->Find("properties")->Find(rest.substr(0, dot));
      rest = dot == std::string_view::npos ? std::string_view() : rest.substr(dot + 1);
    }
    ASSERT_NE(at, nullptr) << parameter.path;
    EXPECT_NE(at->Find("description"), nullptr) << parameter.path;
  }
}

}  // namespace
}  // namespace rockyard::scenario
