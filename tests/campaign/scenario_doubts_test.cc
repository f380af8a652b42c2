#include "campaign/scenario_doubts.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/json_text.h"
#include "core/test_folder.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// The paths that are doubted, of a scenario in layers from top to bottom.
std::vector<std::string> PathsOf(const std::vector<const char*>& texts) {
  Layers layers;
  core::JsonValue merged = core::JsonValue::Object();
  for (const char* text : texts) layers.push_back(core::ParseJson(text, "layer"));
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) merged.Merge(*layer);
  std::vector<std::string> paths;
  for (const core::Problem& doubt : Doubts(scenario::ReadScenario(merged), layers)) {
    paths.push_back(doubt.path);
  }
  return paths;
}

constexpr const char* kFar = R"({"course": {"goal_x_m": 30},
                                 "terrain": {"arena": {"kind": "open", "length_m": 40}}})";

TEST(ScenarioDoubts, LimitsOfAShorterCourse) {
  constexpr const char* kShort = R"({"referee": {"no_path_distance_m": 4, "no_path_time_s": 3600,
                                                 "time_limit_s": 14400},
                                     "energy": {"battery_wh": 50}})";
  EXPECT_THAT(PathsOf({kFar, kShort}),
              ElementsAre("referee.no_path_distance_m", "referee.no_path_time_s",
                          "referee.time_limit_s", "energy.battery_wh"));
  // They were stated by who knew the course; a course as it was; none is a limit.
  EXPECT_THAT(PathsOf({kShort, kFar}), IsEmpty());
  EXPECT_THAT(PathsOf({R"({"course": {"goal_x_m": 7}})", kShort}), IsEmpty());
  EXPECT_THAT(PathsOf({kFar, R"({"referee": {"no_path_distance_m": 0, "no_path_time_s": 0,
                                             "time_limit_s": 0}, "energy": {"battery_wh": 0}})"}),
              IsEmpty());
  // Left open they follow the course; batteries do not.
  EXPECT_THAT(PathsOf({kFar}), ElementsAre("energy.battery_wh"));
  EXPECT_THAT(PathsOf({R"({"course": {"goal_x_m": 30}, "referee": {"no_path_distance_m": null},
                           "terrain": {"arena": {"kind": "open", "length_m": 40}}})",
                       kShort}),
              testing::Not(testing::Contains("referee.no_path_distance_m")));
}

constexpr const char* kLarge = R"({"rover": {"geometry": {
    "wheel_radius_m": 0.15, "length_m": 1.7, "width_m": 1.3, "height_m": 0.6, "wheelbase_m": 1.1,
    "belly_clearance_m": 0.3, "bogie_pivot_z_m": 0.3, "rocker_pivot_z_m": 0.4, "knee_z_m": 0.31,
    "arm_y_m": 0.4, "belly_length_m": 0.9, "belly_width_m": 0.6}},
    "terrain": {"arena": {"kind": "open", "length_m": 20}}})";

TEST(ScenarioDoubts, WhatWasMeantForASmallerRover) {
  EXPECT_THAT(PathsOf({kLarge}),
              ElementsAre("rover.mass", "course.goal_radius_m", "sensors.light_stripe"));
  EXPECT_THAT(PathsOf({R"({"rover": {"mass": {"total_kg": 100}}, "course": {"goal_radius_m": 0.65},
                           "sensors": {"light_stripe": {}}})",
                       kLarge}),
              IsEmpty());
}

TEST(ScenarioDoubts, TheSizeThatTheNavigatorBelievesIn) {
  constexpr const char* kBase = R"({"navigation": {"navigator": "gestalt", "gestalt": {
      "map": {"rover": {"width_m": 0.84}}}}})";
  constexpr const char* kNarrow = R"({"rover": {"geometry": {"width_m": 0.48}}})";
  EXPECT_THAT(PathsOf({kNarrow, kBase}), ElementsAre("navigation.gestalt.map.rover"));
  EXPECT_THAT(PathsOf({kBase, kNarrow}), IsEmpty());
  EXPECT_THAT(PathsOf({kNarrow, R"({"navigation": {"navigator": "gestalt", "gestalt": {
                           "map": {"rover": {"width_m": 0.5}}}}})"}),
              IsEmpty());
  EXPECT_THAT(PathsOf({kNarrow}), IsEmpty()) << "another navigator";
  // A tenth of the width is no other vehicle.
  EXPECT_THAT(PathsOf({R"({"rover": {"geometry": {"width_m": 0.78}}})", kBase}), IsEmpty());
  EXPECT_THAT(PathsOf({R"({"rover": {"geometry": {"width_m": 0.7}}})", kBase}),
              ElementsAre("navigation.gestalt.map.rover"));
}

TEST(ScenarioDoubts, GravityAndSandOfEarthUnderANameThatSaysMars) {
  for (const char* name : {"mars", "mars_20m", "on Mars", "2nd-Mars"}) {
    const std::string text = std::string(R"({"name": ")") + name + "\"}";
    EXPECT_THAT(PathsOf({text.c_str()}),
                ElementsAre("rover.physics.gravity_m_s2", "terrain.ground.soil"))
        << name;
  }
  EXPECT_THAT(PathsOf({R"({"name": "marsupial"})"}), IsEmpty());
  EXPECT_THAT(PathsOf({R"({"name": "mars", "rover": {"physics": {"gravity_m_s2": 9.81}},
                           "terrain": {"ground": {"soil": {"preset": "landscaping_sand"}}}})"}),
              IsEmpty());
  EXPECT_THAT(PathsOf({R"({"name": "mars"})", R"({"rover": {"physics": {"gravity_m_s2": 3.72}},
                           "terrain": {"ground": {"soil": {"preset": "mars_drift"}}}})"}),
              IsEmpty());
}

// Nobody's first run begins with doubts of ours.
TEST(ScenarioDoubts, NoneOfTheScenariosThatComeWithRockyard) {
  int files = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(std::string(ROCKYARD_SOURCE_DIR) + "/scenarios")) {
    const std::string folder = entry.path().parent_path().filename().string();
    if (entry.path().extension() != ".json" || folder == "sweeps" || folder == "rovers" ||
        folder == "sensors" || folder == "navigation") {
      continue;
    }
    ++files;
    for (const core::Problem& doubt : DoubtsOf(entry.path(), {})) {
      ADD_FAILURE() << entry.path() << ": " << TextOf(doubt);
    }
  }
  EXPECT_GT(files, 50);
}

TEST(DoubtsOfSweeps, WhatTheSweepChangesOfItsBase) {
  const auto doubts = [](const std::string& goals) {
    return DoubtsOf(scenario::ParseSweep(
        R"({"name": "far", "scenario": {"referee": {"no_path_distance_m": 4},
            "energy": {"battery_wh": 0}, "terrain": {"arena": {"kind": "open", "length_m": 60}}},
            "trials": 1, "seed": 1,
            "axes": [{"path": "course.goal_x_m", "values": [)" +
        goals + "]}]}"));
  };
  EXPECT_THAT(doubts("7, 15"), IsEmpty());
  const std::vector<core::Problem> one = doubts("7, 30");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].path, "cell goal_x_m=30: referee.no_path_distance_m");
  EXPECT_EQ(one[0].reason, "4 m are little for a course of 30 m");
  EXPECT_EQ(doubts("7, 30, 40")[0].reason,
            "4 m are little for a course of 30 m (and so in 1 more cell)");
  const std::vector<core::Problem> several = doubts("7, 30, 40, 50");
  ASSERT_EQ(several.size(), 1U);
  EXPECT_EQ(several[0].reason, "4 m are little for a course of 30 m (and so in 2 more cells)");
}

TEST(DoubtsOfSweeps, TheNameIsTheSweeps) {
  const std::vector<core::Problem> doubts = DoubtsOf(scenario::ParseSweep(
      R"({"name": "mars", "trials": 1, "seed": 1,
          "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001]}]})"));
  ASSERT_EQ(doubts.size(), 2U);
  EXPECT_EQ(doubts[0].path, "cell k_per_m2=0.001: rover.physics.gravity_m_s2");
}

TEST(DoubtsOfSweeps, NoneOfThoseThatComeWithRockyard) {
  int files = 0;
  for (const auto& entry :
       fs::directory_iterator(std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/sweeps")) {
    if (entry.path().extension() != ".json") continue;
    ++files;
    for (const core::Problem& doubt : DoubtsOf(scenario::LoadSweep(entry.path()))) {
      ADD_FAILURE() << entry.path() << ": " << TextOf(doubt);
    }
  }
  EXPECT_GT(files, 4);
}

// A rover file of one's own over another one's: the value "rover" extends it, not the scenario.
TEST(DoubtsOfFiles, ValuesInAFileExtendFilesToo) {
  const core::TestFolder folder;
  const auto path = [&](const char* name) { return folder.path() / name; };
  std::ofstream(path("small.json"))
      << R"({"geometry": {"length_m": 0.65}, "mass": {"total_kg": 60}})";
  std::ofstream(path("mine.json")) << R"({"extends": "small.json", "geometry": {"width_m": 0.5}})";
  std::ofstream(path("base.json"))
      << R"({"perception": {"dead_reckoning": {"distance_scale": 0.9}}})";
  std::ofstream(path("over.json"))
      << R"({"extends": "base.json", "rover": {"extends": "mine.json"}})";
  std::vector<std::string> paths;
  for (const core::Problem& doubt : DoubtsOf(path("over.json"), {})) paths.push_back(doubt.path);
  EXPECT_THAT(paths, ElementsAre("rover.mass", "perception.dead_reckoning.distance_scale"));
  std::ofstream(path("over.json"))
      << R"({"extends": "base.json", "rover": {"extends": "mine.json", "mass": {"total_kg": 60}},
             "perception": {"dead_reckoning": {"distance_scale": 0.9}}})";
  EXPECT_THAT(DoubtsOf(path("over.json"), {}), IsEmpty());
}

// Of a list of files the last lies on top: it knew the others.
TEST(DoubtsOfFiles, TheLastOfAListLiesOnTop) {
  const core::TestFolder folder;
  const auto path = [&](const char* name) { return folder.path() / name; };
  std::ofstream(path("rover.json")) << R"({"rover": {"geometry": {"width_m": 0.5}}})";
  std::ofstream(path("odometer.json"))
      << R"({"perception": {"dead_reckoning": {"distance_scale": 0.9}}})";
  std::ofstream(path("knows.json")) << R"({"extends": ["rover.json", "odometer.json"]})";
  std::ofstream(path("does_not.json")) << R"({"extends": ["odometer.json", "rover.json"]})";
  EXPECT_THAT(DoubtsOf(path("knows.json"), {}), IsEmpty());
  EXPECT_EQ(DoubtsOf(path("does_not.json"), {}).size(), 1U);
}

TEST(DoubtsOfFiles, OverridesLieOnTopAndBasesBelow) {
  const core::TestFolder folder;
  const auto path = [&](const char* name) { return folder.path() / name; };
  std::ofstream(path("base.json")) << R"({"referee": {"no_path_distance_m": 4}})";
  std::ofstream(path("over.json"))
      << R"({"extends": ["base.json"], "course": {"goal_x_m": 30}, "energy": {"battery_wh": 0},
             "terrain": {"arena": {"kind": "open", "length_m": 40}}})";
  const auto doubts = DoubtsOf(path("over.json"), {});
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_THAT(TextOf(doubts[0]),
              HasSubstr("referee.no_path_distance_m: 4 m are little for a course of 30 m; "));
  EXPECT_THAT(DoubtsOf(path("over.json"), std::vector<std::string>{"referee.no_path_distance_m=5"}),
              IsEmpty());
  EXPECT_EQ(
      DoubtsOf(path("base.json"),
               std::vector<std::string>{"course.goal_x_m=30", "energy.battery_wh=0",
                                        "terrain.arena.kind=open", "terrain.arena.length_m=40"})
          .size(),
      0U)
      << "who names the base states what it says";
}

}  // namespace
}  // namespace rockyard::campaign
