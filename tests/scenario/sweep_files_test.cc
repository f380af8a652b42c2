// The sweep files of the project.
#include <gmock/gmock.h>

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
