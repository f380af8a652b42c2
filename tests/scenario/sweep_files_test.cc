// The sweep files of the project.

#include <filesystem>
#include <set>

#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::scenario {
namespace {

const std::filesystem::path kSweeps = ROCKYARD_SOURCE_DIR "/scenarios/sweeps";

TEST(SweepFilesTest, EveryFileIsASweepWithADescription) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSweeps)) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().filename().string());
    const Sweep sweep = LoadSweep(entry.path());
    EXPECT_EQ(sweep.name, entry.path().stem().string());
    EXPECT_FALSE(sweep.description.empty());
    ++files;
  }
  EXPECT_GE(files, 4);
}

TEST(SweepFilesTest, AbundanceVariesAbundanceAlone) {
  const Sweep sweep = LoadSweep(kSweeps / "abundance.json");
  std::set<std::uint64_t> rest;
  for (const SweepCell& cell : sweep.cells) {
    Scenario scenario = cell.scenario;
    scenario.drive.terrain.rocks.k_per_m2 = 0.00415;
    scenario.seed = 1;
    rest.insert(Fingerprint(scenario));
  }
  EXPECT_EQ(rest.size(), 1u);
  EXPECT_EQ(sweep.fit_axis, 0u);
}

// Sand, half of nominal terrain, nominal, twice it, Viking Lander 2: Matthies 1995, section 7.
TEST(SweepFilesTest, DeadReckoningIsSweptOverAbundanceDistanceAndItsErrors) {
  const Sweep abundance = LoadSweep(kSweeps / "dead_reckoning_abundance.json");
  ASSERT_EQ(abundance.cells.size(), 5u);
  EXPECT_EQ(abundance.cells[0].scenario.drive.terrain.rocks.k_per_m2, 0.0);
  EXPECT_EQ(abundance.cells[2].scenario.drive.terrain.rocks.k_per_m2, 0.00415);
  EXPECT_EQ(abundance.cells[4].scenario.drive.terrain.rocks.k_per_m2, 0.013);

  const Sweep distance = LoadSweep(kSweeps / "dead_reckoning_distance.json");
  ASSERT_EQ(distance.cells.size(), 7u);
  for (const SweepCell& cell : distance.cells) {
    EXPECT_EQ(cell.scenario.drive.terrain.arena.kind, terrain::ArenaKind::kOpen);
  }
  EXPECT_EQ(distance.cells[4].scenario.drive.course.goal_x_m, 10.0);

  const Sweep shares = LoadSweep(kSweeps / "dead_reckoning_shares.json");
  ASSERT_EQ(shares.cells.size(), 8u);
  const sensing::GyroParams& as_flown = shares.cells.front().scenario.drive.sensors.gyro;
  EXPECT_EQ(as_flown.heading_variance_deg2_per_m, 0.70);
  EXPECT_EQ(as_flown.scale, 0.94);
  EXPECT_TRUE(as_flown.scrape.enabled);
  const sensing::GyroParams& perfect = shares.cells.back().scenario.drive.sensors.gyro;
  EXPECT_EQ(perfect.heading_variance_deg2_per_m, 0.0);
  EXPECT_EQ(perfect.scale, 1.0);
  EXPECT_FALSE(perfect.scrape.enabled);
}

TEST(SweepFilesTest, NavigatorsMeetTheSameRocks) {
  const Sweep sweep = LoadSweep(kSweeps / "navigators.json");
  ASSERT_EQ(sweep.cells.size(), 8u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Scenario& behaviour = sweep.cells[i].scenario;
    const Scenario& gestalt = sweep.cells[i + 4].scenario;
    EXPECT_EQ(behaviour.seed, gestalt.seed);
    EXPECT_EQ(behaviour.drive.navigation.navigators.chosen().name(), "pathfinder");
    EXPECT_EQ(gestalt.drive.navigation.navigators.chosen().name(), "gestalt");
    EXPECT_EQ(behaviour.drive.terrain.rocks.k_per_m2, gestalt.drive.terrain.rocks.k_per_m2);
    EXPECT_EQ(behaviour.drive.course.goal_x_m, gestalt.drive.course.goal_x_m);
  }
}

}  // namespace
}  // namespace rockyard::scenario
