// The committed scenarios hold what Matthies 1995 states, and differ in nothing else; what those of
// the lander's map, and its sweeps, may differ in.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/files.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "navigation/pathfinder/pathfinder_params.h"
#include "scenario/load.h"
#include "scenario/shipped.h"
#include "scenario/sweep.h"

namespace rockyard::scenario {
namespace {

const std::filesystem::path kRoot = ROCKYARD_SOURCE_DIR;

Scenario Load(const std::string& name) { return Shipped("pathfinder/" + name); }

std::map<std::string, Scenario> LoadAll() {
  std::map<std::string, Scenario> scenarios;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "scenarios")) {
    if (entry.path().extension() != ".json") continue;
    const std::string folder = entry.path().parent_path().filename().string();
    if (folder == "navigation" || folder == "rovers" || folder == "sensors") continue;  // parts
    const std::string file = entry.path().string();
    if (IsSweep(core::ParseJson(core::ReadTextFile(file, 1 << 20, "a file"), file))) continue;
    const std::map<std::string, std::string> prefixes = {{"bench", "bench_"},
                                                         {"continuous", "continuous_"},
                                                         {"courses", "course_"},
                                                         {"outsider", "course_outsider_"},
                                                         {"arc_planning", "arc_planning_"},
                                                         {"gestalt", "gestalt_"}};
    const auto found = prefixes.find(folder);
    const std::string prefix = found == prefixes.end() ? "" : found->second;
    scenarios.emplace(prefix + entry.path().stem().string(), LoadScenario(entry.path()));
  }
  return scenarios;
}

// Paths of the parameters that two scenarios do not share.
std::set<std::string> Differences(const Scenario& a, const Scenario& b) {
  const auto values = [](const Scenario& scenario) {
    std::map<std::string, core::ParameterInfo> by_path;
    for (const core::ParameterInfo& parameter : ListParameters(scenario)) {
      by_path.emplace(parameter.path, parameter);
    }
    return by_path;
  };
  const auto of_b = values(b);
  std::set<std::string> paths;
  for (const auto& [path, parameter] : values(a)) {
    if (core::DumpJson(parameter.value) != core::DumpJson(of_b.at(path).value)) paths.insert(path);
  }
  paths.erase("name");
  paths.erase("description");
  return paths;
}

double ObstaclesPerM2(const Scenario& scenario) {
  const terrain::RockFieldParams& rocks = scenario.drive.terrain.rocks;
  return static_cast<double>(rocks.count) / (rocks.count_area_length_m * rocks.count_area_width_m);
}

// Those of the hazard studies begin with "hazard_", those of the stereo studies with "stereo_", and
// those of the map-based navigator with "gestalt_" or "continuous_", which their folders say
// already.
TEST(PathfinderFilesTest, NamesAreFileNames) {
  const std::map<std::string, Scenario> scenarios = LoadAll();
  ASSERT_GE(scenarios.size(), 9u);
  for (const auto& [stem, scenario] : scenarios) {
    std::string prefix;
    if (scenario.experiment.chosen().name() == "hazard_detection") prefix = "hazard_";
    if (scenario.experiment.chosen().name() == "stereo_sensing") prefix = "stereo_";
    if (scenario.experiment.chosen().name() == "cylinder_sighting") prefix = "cylinder_";
    EXPECT_EQ(scenario.name, prefix + stem);
    EXPECT_FALSE(scenario.description.empty()) << stem;
  }
}

TEST(PathfinderFilesTest, EveryPublishedValueHasItsScenario) {
  const std::map<std::string, Scenario> scenarios = LoadAll();
  const core::JsonValue reference =
      core::LoadJsonFile(kRoot / "results" / "reference" / "matthies1995.json");
  for (const core::JsonValue& value : reference.Find("values")->list()) {
    for (const char* key : {"scenario", "other_scenario"}) {
      const core::JsonValue* name = value.Find(key);
      if (name == nullptr) continue;
      EXPECT_TRUE(scenarios.contains(name->text())) << value.Find("id")->text();
    }
  }
}

TEST(PathfinderFilesTest, CourseIsThePublishedOneAndTheBoundThatChecksUse) {
  const core::JsonValue reference =
      core::LoadJsonFile(kRoot / "results" / "reference" / "matthies1995.json");
  for (const core::JsonValue& value : reference.Find("values")->list()) {
    if (value.Find("statistic")->text() != "lower_bound") continue;
    const Scenario scenario = Load(value.Find("scenario")->text());
    EXPECT_EQ(scenario.drive.course.goal_x_m - scenario.drive.course.start_x_m,
              value.Find("value")->number());
  }
  EXPECT_EQ(Load("nominal").drive.course.goal_x_m, 7.6);     // Matthies 1995 sec. 7
  EXPECT_EQ(Load("level_sand").drive.course.goal_x_m, 7.0);  // sec. 5
  EXPECT_EQ(Load("level_sand").drive.terrain.rocks.RocksPerM2(), 0.0);
}

TEST(PathfinderFilesTest, MooreConstantsArePublished) {
  EXPECT_EQ(Load("nominal").drive.terrain.rocks.k_per_m2, 0.00415);  // Matthies 1995 sec. 7
  EXPECT_EQ(Load("vl2").drive.terrain.rocks.k_per_m2, 0.013);
}

TEST(PathfinderFilesTest, ObstacleCountsArePublished) {
  const std::map<std::string, std::int64_t> counts = {
      {"obstacles_0.28", 5}, {"obstacles_0.57", 10}, {"obstacles_0.85", 15}};
  for (const auto& [name, count] : counts) {
    const terrain::RockFieldParams rocks = Load(name).drive.terrain.rocks;
    EXPECT_EQ(rocks.count, count);
    EXPECT_NEAR(rocks.count_area_length_m * rocks.count_area_width_m, 17.6, 1e-9);
    EXPECT_EQ(rocks.uniform_min_diameter_m, 0.25);
    EXPECT_EQ(rocks.uniform_max_diameter_m, 0.35);
  }
}

// Densities as the paper prints them (0.57 is 10 / 17.6, which rounds so).
TEST(PathfinderFilesTest, DensitiesAreThoseOfTheNames) {
  for (const auto& [stem, scenario] : LoadAll()) {
    const std::string prefix = "obstacles_";
    if (stem.rfind(prefix, 0) != 0) continue;
    const double printed = std::stod(stem.substr(prefix.size()));
    EXPECT_NEAR(ObstaclesPerM2(scenario), printed, 0.005) << stem;
  }
}

TEST(PathfinderFilesTest, TestArenaIsPublished) {
  const Scenario nominal = Load("nominal");
  EXPECT_EQ(nominal.drive.terrain.arena.kind, terrain::ArenaKind::kVirtualReflected);
  EXPECT_EQ(nominal.drive.terrain.arena.length_m, 12.0);  // Matthies 1995 sec. 3
  EXPECT_EQ(nominal.drive.terrain.arena.width_m, 4.0);
  EXPECT_EQ(nominal.drive.terrain.arena.mirror_margin_m, 0.9);              // sec. 7
  EXPECT_NEAR(2.0 * nominal.drive.terrain.arena.MirrorLine(), 2.2, 1e-12);  // central 2.2 m
  EXPECT_EQ(nominal.drive.rover.drive.speed_m_s, 0.15);                     // sec. 5
  EXPECT_EQ(
      nominal.drive.navigation.navigators.params<navigation::PathfinderParams>().scan_interval_m,
      0.065);                                                               // one wheel radius
  EXPECT_EQ(nominal.drive.sensors.gyro.heading_variance_deg2_per_m, 0.70);  // sec. 5
  EXPECT_EQ(nominal.drive.sensors.encoders.distance_variance_m2_per_m, 0.0039);
  EXPECT_EQ(nominal.drive.sensors.gyro.scale, 0.94);  // sec. 8
}

TEST(PathfinderFilesTest, ScenariosDifferInWhatTheyAreNamedAfterAlone) {
  const Scenario nominal = Load("nominal");
  using Paths = std::set<std::string>;
  EXPECT_EQ(Differences(nominal, Load("nominal_perfect_localization")),
            Paths{"localization.estimator"});
  EXPECT_EQ(Differences(nominal, Load("vl2")), Paths{"terrain.rocks.k_per_m2"});
  EXPECT_EQ(Differences(nominal, Load("obstacles_0.28")), Paths{"terrain.rocks.kind"});
  for (const char* name : {"obstacles_0.57", "obstacles_0.85"}) {
    EXPECT_EQ(Differences(Load("obstacles_0.28"), Load(name)), Paths{"terrain.rocks.count"});
  }
  EXPECT_EQ(Differences(nominal, Load("level_sand")),
            (Paths{"course.goal_x_m", "perception.hazard.enabled", "terrain.arena.kind",
                   "terrain.rocks.kind"}));
}

// With the map and the navigator of map_none nothing is left that differs; map_none is the nominal
// terrain with designated goals.
TEST(LanderMapFilesTest, TheyDifferInMapAndNavigatorAlone) {
  Scenario none = Shipped("localization/map_none");
  std::set<std::uint64_t> own;
  for (const std::string name :
       {"map_none", "map_lander", "map_lander_merged", "map_oracle", "map_oracle_merged"}) {
    SCOPED_TRACE(name);
    Scenario scenario = Shipped("localization/" + name);
    EXPECT_EQ(scenario.name, name);
    own.insert(Fingerprint(scenario));
    const bool lander = name.starts_with("map_lander");
    EXPECT_EQ(scenario.drive.course.route_map.source == trial::RouteMap::kLander, lander);
    const bool merged = name.ends_with("merged");
    EXPECT_EQ(scenario.drive.course.route_map.use == trial::RouteUse::kWaypoints, merged);
    const bool follows = scenario.drive.navigation.navigators.chosen().traits().follows_route;
    EXPECT_EQ(follows, !merged && name != "map_none");
    scenario.drive.course.route_map = none.drive.course.route_map;
    scenario.drive.navigation = none.drive.navigation;
    EXPECT_EQ(Fingerprint(scenario), Fingerprint(none));
  }
  EXPECT_EQ(own.size(), 5U);
  none.drive.course.designation.enabled = false;
  EXPECT_EQ(Fingerprint(none), Fingerprint(Load("nominal")));
}

TEST(LanderMapFilesTest, TheSweepHasEveryMapAtEveryAbundance) {
  const Sweep sweep = LoadSweep(kRoot / "scenarios/sweeps/lander_map.json");
  ASSERT_EQ(sweep.cells.size(), 20U);
  for (const std::size_t first : {0U, 5U, 10U, 15U}) {
    for (std::size_t i = 0; i < 5; ++i) {
      const Scenario& scenario = sweep.cells[first + i].scenario;
      const trial::RouteMapParams& map = scenario.drive.course.route_map;
      EXPECT_EQ(map.source == trial::RouteMap::kLander, i == 1 || i == 2);
      EXPECT_EQ(map.use == trial::RouteUse::kWaypoints, i == 2 || i == 4);
      EXPECT_EQ(scenario.drive.terrain.rocks.k_per_m2, first % 10 == 0 ? 0.00415 : 0.013);
      EXPECT_EQ(scenario.seed, sweep.cells[0].scenario.seed);
      EXPECT_TRUE(scenario.drive.course.designation.enabled);
    }
  }
}

TEST(LanderMapFilesTest, TheSweepOfRangesMovesTheLanderAlone) {
  const Sweep sweep = LoadSweep(kRoot / "scenarios/sweeps/lander_map_range.json");
  ASSERT_EQ(sweep.cells.size(), 24U);
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    Scenario scenario = sweep.cells[i].scenario;
    EXPECT_LE(scenario.drive.course.designation.lander_ahead_m, 0.0);
    scenario.drive.course.designation.lander_ahead_m = 0.0;
    EXPECT_EQ(Fingerprint(scenario), Fingerprint(sweep.cells[i % 4].scenario));
  }
}

// The preset switches on every remedy that there is, and nothing else.
TEST(RemediedFile, SwitchesOnEveryRemedy) {
  const std::filesystem::path folder = kRoot / "scenarios/continuous";
  const Scenario remedied =
      ParseScenario(R"({"extends": ["csad.json", "../navigation/remedied.json"]})", {}, folder);
  std::set<std::string> every{"perception.cloud_elevations.frame"};
  for (const core::ParameterInfo& parameter : ListParameters(remedied)) {
    const bool switches = parameter.path.starts_with("navigation.gestalt.remedies.") &&
                          parameter.path.ends_with(".enabled");
    if (switches) every.insert(parameter.path);
  }
  EXPECT_EQ(every.size(), 5U);
  EXPECT_EQ(Differences(LoadScenario(folder / "csad.json"), remedied), every);
}

}  // namespace
}  // namespace rockyard::scenario
