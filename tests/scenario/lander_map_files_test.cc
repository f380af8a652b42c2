// The scenarios and sweeps of the lander's map: what they may differ in.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::scenario {
namespace {

const std::filesystem::path kScenarios = ROCKYARD_SOURCE_DIR "/scenarios";

Scenario Load(const std::string& name) {
  return LoadScenario(kScenarios / "localization" / (name + ".json"));
}

// With the map and the navigator of map_none nothing is left that differs; map_none is the nominal
// terrain with designated goals.
TEST(LanderMapFilesTest, TheyDifferInMapAndNavigatorAlone) {
  Scenario none = Load("map_none");
  std::set<std::uint64_t> own;
  for (const std::string name :
       {"map_none", "map_lander", "map_lander_merged", "map_oracle", "map_oracle_merged"}) {
    SCOPED_TRACE(name);
    Scenario scenario = Load(name);
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
  EXPECT_EQ(Fingerprint(none), Fingerprint(LoadScenario(kScenarios / "pathfinder/nominal.json")));
}

TEST(LanderMapFilesTest, TheSweepHasEveryMapAtEveryAbundance) {
  const Sweep sweep = LoadSweep(kScenarios / "sweeps/lander_map.json");
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
  const Sweep sweep = LoadSweep(kScenarios / "sweeps/lander_map_range.json");
  ASSERT_EQ(sweep.cells.size(), 24U);
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    Scenario scenario = sweep.cells[i].scenario;
    EXPECT_LE(scenario.drive.course.designation.lander_ahead_m, 0.0);
    scenario.drive.course.designation.lander_ahead_m = 0.0;
    EXPECT_EQ(Fingerprint(scenario), Fingerprint(sweep.cells[i % 4].scenario));
  }
}

}  // namespace
}  // namespace rockyard::scenario
