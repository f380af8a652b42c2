// Rules that every parameter of every module keeps.

#include <cmath>
#include <set>

#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::scenario {
namespace {

using core::FieldKind;
using core::ParameterInfo;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

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

constexpr const char* kOpenArena =
    R"("terrain": {"arena": {"kind": "open", "length_m": 70, "width_m": 30}})";

trial::RefereeParams RefereeOf(const std::string& members) {
  return ParseScenario("{" + members + "}").drive.referee;
}

TEST(OpenValues, AreThoseOfThePublishedCourseUpToItsLength) {
  for (const char* goal : {"3", "7.6"}) {
    const auto referee = RefereeOf(std::string(R"("course": {"goal_x_m": )") + goal + "}");
    EXPECT_EQ(referee.no_path_progress_m, 0.25);
    EXPECT_EQ(referee.no_path_distance_m, 4.0);
    EXPECT_EQ(referee.no_path_time_s, 3600.0);
    EXPECT_NEAR(referee.time_limit_s, 14400.0, 1e-9);
  }
}

// 30 m by way of (10, 0), (10, 10) and (20, 10), for a rover 0.8 m wide.
TEST(OpenValues, FollowCourseAndRover) {
  const auto referee = RefereeOf(std::string(R"("course": {"goal_x_m": 20, "goal_y_m": 10,
                               "waypoints": {"x_m": [10, 10], "y_m": [0, 10]}},
                    "rover": {"geometry": {"width_m": 0.8}},)") +
                                 kOpenArena);
  EXPECT_DOUBLE_EQ(referee.no_path_progress_m, 0.4);
  EXPECT_DOUBLE_EQ(referee.no_path_distance_m, 15.0);
  EXPECT_DOUBLE_EQ(referee.no_path_time_s, 13500.0);
  EXPECT_DOUBLE_EQ(referee.time_limit_s, 14400.0 * 30.0 / 7.6);
}

TEST(OpenValues, WhatIsStatedStaysAndNullIsOpen) {
  const std::string far = std::string(R"("course": {"goal_x_m": 60},)") + kOpenArena;
  const auto stated =
      RefereeOf(R"("referee": {"no_path_distance_m": 4, "time_limit_s": 0},)" + far);
  EXPECT_EQ(stated.no_path_distance_m, 4.0);
  EXPECT_EQ(stated.time_limit_s, 0.0);
  EXPECT_EQ(stated.no_path_time_s, 27000.0);
  const auto open =
      RefereeOf(R"("referee": {"no_path_distance_m": null, "stall_window_s": 7},)" + far);
  EXPECT_EQ(open.no_path_distance_m, 30.0);
  EXPECT_EQ(open.stall_window_s, 7.0);
  EXPECT_THROW(RefereeOf(R"("referee": {"stall_window_s": null})"), core::UserError);
}

// A file that states a limit can be told to leave it open, also on the command line.
TEST(OpenValues, OverridesMayOpenThem) {
  const std::string text = std::string(R"({"referee": {"no_path_distance_m": 4},
      "course": {"goal_x_m": 60},)") +
                           kOpenArena + "}";
  const std::vector<std::string> open = {"referee.no_path_distance_m=null"};
  EXPECT_EQ(ParseScenario(text, open).drive.referee.no_path_distance_m, 30.0);
}

// Cameras beside gates or on a core of today are not those of the Athena SDM; older computers keep
// its time.
TEST(OpenValues, ImagesTakeAsLongAsTheComputerSuggests) {
  const auto acquisition_s = [](const std::string& compute) {
    return ParseScenario(R"({"clock": {"compute": {)" + compute + "}}}")
        .drive.clock.compute.acquisition_s;
  };
  for (const char* fast : {"virtex_5_fpga", "athena_2012", "sapphire_rapids_core"}) {
    const std::string computer = std::string(R"("computer": ")") + fast + '"';
    EXPECT_EQ(acquisition_s(computer), 0.1) << fast;
    EXPECT_EQ(acquisition_s(computer + R"(, "acquisition_s": null)"), 0.1) << fast;
    EXPECT_EQ(acquisition_s(computer + R"(, "acquisition_s": 8.974)"), 8.974) << fast;
    EXPECT_EQ(acquisition_s(computer + R"(, "acquisition_s": 0)"), 0.0) << fast;
  }
  for (const char* slow :
       {"none", "r3000_12mhz", "pentium_3_500mhz", "sparc_300mhz", "rad6000_20mhz", "mer_rad6000",
        "msl_rad750", "sparc_10", "powerpc_750_133mhz", "powerpc_g4_500mhz"}) {
    EXPECT_EQ(acquisition_s(std::string(R"("computer": ")") + slow + '"'), 8.974) << slow;
  }
  EXPECT_EQ(ParseScenario("{}").drive.clock.compute.acquisition_s, 8.974);
}

TEST(OpenValues, AResolvedScenarioReadsBackToTheSame) {
  const Scenario scenario =
      ParseScenario(std::string(R"({"course": {"goal_x_m": 60},)") + kOpenArena + "}");
  EXPECT_EQ(ResolvedJson(ParseScenario(ResolvedJson(scenario))), ResolvedJson(scenario));
}

TEST(OpenValues, TheSchemaKnows) {
  const core::JsonValue schema = core::ParseJson(SchemaJson(), "schema");
  const auto type = [&](const char* key) {
    return core::DumpJson(
        *schema.Find("properties")->Find("referee")->Find("properties")->Find(key)->Find("type"));
  };
  EXPECT_THAT(type("no_path_time_s"), testing::HasSubstr("null"));
  EXPECT_THAT(type("stall_window_s"), testing::Not(testing::HasSubstr("null")));
  const core::JsonValue& clock = *schema.Find("properties")->Find("clock")->Find("properties");
  const core::JsonValue& compute = *clock.Find("compute")->Find("properties");
  EXPECT_THAT(core::DumpJson(*compute.Find("acquisition_s")->Find("type")),
              testing::HasSubstr("null"));
  EXPECT_THAT(core::DumpJson(*compute.Find("behaviour_s")->Find("type")),
              testing::Not(testing::HasSubstr("null")));
}

}  // namespace
}  // namespace rockyard::scenario
