// What the rover felt, as the map keeps it.
#include <gtest/gtest.h>

#include <cmath>

#include "navigation/gestalt/clouds.h"

namespace rockyard::navigation {
namespace {

using math::Transform;

TEST(GestaltMarksTest, WhatTheRoverFeltIsAnObstacleUntilItAges) {
  GestaltMapParams params = HandParams();
  params.max_idles = 2;
  GestaltMap map = MapOf(params, PointsOn(kWholeWindow, Level));
  map.MarkObstacle(0.1, 0.1, 0.05);  // cell (10, 10) alone: every patch within two cells
  const GoodnessGrid& grid = map.Evaluate();
  const CellValue obstacle{0, 255, true}, best{255, 255, true};
  for (int i = 5; i < 16; ++i) {
    EXPECT_EQ(grid.Cell(i, 10), std::abs(i - 10) <= 2 ? obstacle : best) << i;
    EXPECT_EQ(grid.Cell(10, i), std::abs(i - 10) <= 2 ? obstacle : best) << i;
  }
  map.MarkObstacle(0.1, 0.1, 0.25);  // the four neighbours too
  EXPECT_EQ(map.Evaluate().Cell(13, 10), obstacle);
  EXPECT_EQ(map.Evaluate().Cell(13, 13), best);
  map.BeginCycle(kHandRover_m, kHandRover_m);
  map.Add(PointsOn(kWholeWindow, Level), Transform::Identity());
  EXPECT_EQ(map.Evaluate().Cell(10, 10), obstacle) << "data do not clear it";
  for (int i = 0; i < 3; ++i) map.BeginCycle(kHandRover_m, kHandRover_m);
  map.Add(PointsOn(kWholeWindow, Level), Transform::Identity());
  EXPECT_EQ(map.Evaluate().Cell(10, 10), best);
}

// It has the pair of table 1 for step obstacles.
TEST(GestaltMarksTest, WhatTheRoverFeltIsAStepObstacle) {
  GestaltMapParams params = HandParams();
  params.pairs.step_obst = {40, 200};
  params.certainty = CellCertainty::kOfHazard;
  GestaltMap map = MapOf(params, PointsOn(kWholeWindow, Level));
  map.MarkObstacle(0.1, 0.1, 0.05);
  EXPECT_EQ(map.Evaluate().Cell(10, 10), (CellValue{40, 200, true}));
}

// A mark is as young as the cycle in which it is made, whatever the age of the data under it.
TEST(GestaltMarksTest, MarksAgeFromTheCycleInWhichTheyAreMade) {
  GestaltMapParams params = HandParams();
  params.max_idles = 2;
  GestaltMap map = MapOf(params, PointsOn(kWholeWindow, Level));
  for (int i = 0; i < 2; ++i) map.BeginCycle(kHandRover_m, kHandRover_m);
  map.MarkObstacle(0.1, 0.1, 0.05);
  const CellValue obstacle{0, 255, true};
  for (int i = 0; i < 2; ++i) {
    map.BeginCycle(kHandRover_m, kHandRover_m);
    EXPECT_EQ(map.Evaluate().Cell(10, 10), obstacle) << i;
  }
  map.BeginCycle(kHandRover_m, kHandRover_m);
  EXPECT_NE(map.Evaluate().Cell(10, 10), obstacle);
}

TEST(GestaltMarksTest, WhatTheRoverFeltIsKnownWhereNothingWasSeen) {
  GestaltMap map(HandParams());
  map.BeginCycle(kHandRover_m, kHandRover_m);
  map.MarkObstacle(0.1, 0.1, 0.05);
  const GoodnessGrid& grid = map.Evaluate();
  EXPECT_EQ(grid.Cell(12, 8), (CellValue{0, 255, true}));
  EXPECT_EQ(grid.Cell(13, 8), (CellValue{11, 0, false}));
}

}  // namespace
}  // namespace rockyard::navigation
