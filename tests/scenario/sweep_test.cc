// Sweep files: cells, seeds, and everything that can be wrong with them.
#include "scenario/sweep.h"

#include <gmock/gmock.h>

#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

using testing::ElementsAre;

std::vector<std::string> Names(const Sweep& sweep) {
  std::vector<std::string> names;
  for (const SweepCell& cell : sweep.cells) names.push_back(cell.name);
  return names;
}

constexpr std::string_view kGrid = R"({
  "name": "grid", "seed": 7, "trials": 20,
  "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.01]},
           {"name": "rover", "levels": [{"name": "slow", "set": {"rover.drive.speed_m_s": 0.05}},
                                        {"name": "fast", "set": {"rover": {"drive": {"speed_m_s": 0.1}}}}]}]
})";

TEST(SweepTest, AGridHasItsLastAxisFastest) {
  const Sweep sweep = ParseSweep(kGrid);
  EXPECT_THAT(Names(sweep), ElementsAre("k_per_m2=0.001,rover=slow", "k_per_m2=0.001,rover=fast",
                                        "k_per_m2=0.01,rover=slow", "k_per_m2=0.01,rover=fast"));
  ASSERT_EQ(sweep.axes.size(), 2u);
  EXPECT_TRUE(sweep.axes[0].numeric);
  EXPECT_EQ(sweep.axes[0].unit, "1/m2");
  EXPECT_FALSE(sweep.axes[1].numeric);
  EXPECT_EQ(sweep.fit_axis, 0u);
  const SweepCell& last = sweep.cells[3];
  EXPECT_EQ(last.scenario.terrain.rocks.k_per_m2, 0.01);
  EXPECT_EQ(last.scenario.rover.drive.speed_m_s, 0.1);
  EXPECT_EQ(last.scenario.trials, 20);
  EXPECT_EQ(last.levels[0].number, 0.01);
  EXPECT_EQ(last.levels[1].text, "fast");
}

}  // namespace
}  // namespace rockyard::scenario
