#include "scenario/open_limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"
#include "core/json_text.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

constexpr const char* kOpenArena =
    R"("terrain": {"arena": {"kind": "open", "length_m": 70, "width_m": 30}})";

trial::RefereeParams RefereeOf(const std::string& members) {
  return ParseScenario("{" + members + "}").drive.referee;
}

TEST(OpenLimits, AreThoseOfThePublishedCourseUpToItsLength) {
  for (const char* goal : {"3", "7.6"}) {
    const auto referee = RefereeOf(std::string(R"("course": {"goal_x_m": )") + goal + "}");
    EXPECT_EQ(referee.no_path_progress_m, 0.25);
    EXPECT_EQ(referee.no_path_distance_m, 4.0);
    EXPECT_EQ(referee.no_path_time_s, 3600.0);
    EXPECT_NEAR(referee.time_limit_s, 14400.0, 1e-9);
  }
}

// 30 m by way of (10, 0), (10, 10) and (20, 10), for a rover 0.8 m wide.
TEST(OpenLimits, FollowCourseAndRover) {
  const auto referee = RefereeOf(std::string(R"("course": {"goal_x_m": 20, "goal_y_m": 10,
                               "waypoints": {"x_m": [10, 10], "y_m": [0, 10]}},
                    "rover": {"geometry": {"width_m": 0.8}},)") +
                                 kOpenArena);
  EXPECT_DOUBLE_EQ(referee.no_path_progress_m, 0.4);
  EXPECT_DOUBLE_EQ(referee.no_path_distance_m, 15.0);
  EXPECT_DOUBLE_EQ(referee.no_path_time_s, 13500.0);
  EXPECT_DOUBLE_EQ(referee.time_limit_s, 14400.0 * 30.0 / 7.6);
}

TEST(OpenLimits, WhatIsStatedStaysAndNullIsOpen) {
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
TEST(OpenLimits, OverridesMayOpenThem) {
  const std::string text = std::string(R"({"referee": {"no_path_distance_m": 4},
      "course": {"goal_x_m": 60},)") +
                           kOpenArena + "}";
  const std::vector<std::string> open = {"referee.no_path_distance_m=null"};
  EXPECT_EQ(ParseScenario(text, open).drive.referee.no_path_distance_m, 30.0);
}

TEST(OpenLimits, AResolvedScenarioReadsBackToTheSame) {
  const Scenario scenario =
      ParseScenario(std::string(R"({"course": {"goal_x_m": 60},)") + kOpenArena + "}");
  EXPECT_EQ(ResolvedJson(ParseScenario(ResolvedJson(scenario))), ResolvedJson(scenario));
}

TEST(OpenLimits, TheSchemaKnows) {
  const core::JsonValue schema = core::ParseJson(SchemaJson(), "schema");
  const auto type = [&](const char* key) {
    return core::DumpJson(
        *schema.Find("properties")->Find("referee")->Find("properties")->Find(key)->Find("type"));
  };
  EXPECT_THAT(type("no_path_time_s"), testing::HasSubstr("null"));
  EXPECT_THAT(type("stall_window_s"), testing::Not(testing::HasSubstr("null")));
}

}  // namespace
}  // namespace rockyard::scenario
