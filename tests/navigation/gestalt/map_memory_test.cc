// What the map keeps of what it saw and of what the rover felt, what it forgets, and what it leaves
// out.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.h"
#include "navigation/gestalt/clouds.h"

namespace rockyard::navigation {
namespace {

using math::Transform;

int CellsWithData(const GestaltMap& map) {
  int count = 0;
  for (const messages::MapCellView& cell : map.View().cells) count += cell.has_data ? 1 : 0;
  return count;
}

bool HasData(GestaltMap& map, double x, double y) {
  map.Evaluate();
  const messages::MapView view = map.View();
  const int ix = static_cast<int>(std::floor((x - view.x0_m) / view.xstep_m));
  const int iy = static_cast<int>(std::floor((y - view.y0_m) / view.ystep_m));
  return view.Cell(ix, iy).has_data;
}

messages::PointCloud OnePoint(double x, double y, double z) { return {.points_R = {{x, y, z}}}; }

TEST(GestaltMemoryTest, CellIsZeroedAfterMaxIdlesCyclesWithoutData) {
  GestaltMapParams params = HandParams();
  params.max_idles = 3;
  GestaltMap map = MapOf(params, OnePoint(0.1, 0.1, 0.0));
  map.Add(OnePoint(0.9, 0.1, 0.0), Transform::Identity());
  for (int idle = 1; idle <= 3; ++idle) {
    map.BeginCycle(kHandRover_m, kHandRover_m);
    EXPECT_TRUE(HasData(map, 0.1, 0.1)) << idle;
    map.Add(OnePoint(0.9, 0.1, 0.0), Transform::Identity());
  }
  map.BeginCycle(kHandRover_m, kHandRover_m);
  EXPECT_FALSE(HasData(map, 0.1, 0.1));
  EXPECT_TRUE(HasData(map, 0.9, 0.1));  // got data all the while
}

TEST(GestaltMemoryTest, ThrowsOutWhatIsFarFromTheRover) {
  GestaltMapParams params = HandParams();
  params.grid_dist_timeout_m = 1.0;
  // Cell centres 1.0 and 1.2 m from the rover.
  GestaltMap map = MapOf(params, OnePoint(1.1, 0.1, 0.0));
  map.Add(OnePoint(1.3, 0.1, 0.0), Transform::Identity());
  EXPECT_TRUE(HasData(map, 1.1, 0.1));
  EXPECT_FALSE(HasData(map, 1.3, 0.1));
  map.BeginCycle(kHandRover_m - 0.01, kHandRover_m);
  EXPECT_FALSE(HasData(map, 1.1, 0.1));
  map.BeginCycle(kHandRover_m, kHandRover_m);
  EXPECT_FALSE(HasData(map, 1.1, 0.1)) << "what was thrown out does not come back";
}

TEST(GestaltMemoryTest, WindowFollowsByWholeCells) {
  GestaltMap map(HandParams());
  map.BeginCycle(0.1, 0.1);
  EXPECT_NEAR(map.Evaluate().x0_m, -2.0, 1e-12);
  map.BeginCycle(0.19, 0.01);
  EXPECT_NEAR(map.Evaluate().x0_m, -2.0, 1e-12);
  EXPECT_NEAR(map.Evaluate().y0_m, -2.0, 1e-12);
  map.BeginCycle(0.21, -0.01);
  EXPECT_NEAR(map.Evaluate().x0_m, -1.8, 1e-12);
  EXPECT_NEAR(map.Evaluate().y0_m, -2.2, 1e-12);
}

TEST(GestaltMemoryTest, CellsThatLeaveTheWindowAreForgotten) {
  GestaltMap map = MapOf(HandParams(), PointsOn(kWholeWindow, Level));
  EXPECT_EQ(CellsWithData(map), 21 * 21);
  map.BeginCycle(kHandRover_m + 0.6, kHandRover_m - 0.2);
  EXPECT_EQ(CellsWithData(map), 18 * 20);
  map.BeginCycle(kHandRover_m, kHandRover_m);
  EXPECT_EQ(CellsWithData(map), 18 * 20);
  map.BeginCycle(500.0, -500.0);
  EXPECT_EQ(CellsWithData(map), 0);
}

// A drive over random ground: a window that just holds what is near, and one so large that nothing
// wraps, say the same of every cell that both have.
TEST(GestaltMemoryTest, WrappingEqualsALargeMap) {
  GestaltMapParams small = HandParams();
  small.grid_dist_timeout_m = 1.5;
  small.max_idles = 15;
  GestaltMapParams large = small;
  large.grid.xN_m = 30.2;
  large.grid.yN_m = 30.2;
  GestaltMap wrapping(small), plain(large);
  core::RandomStream stream({51, 0}, core::Purpose::kTest, 1);
  int known = 0;
  for (int step = 0; step < 120; ++step) {
    const double x = 6.0 * std::sin(0.05 * step), y = 5.0 * std::cos(0.08 * step);
    messages::PointCloud cloud;
    for (int i = 0; i < 400; ++i) {
      cloud.points_R.push_back({core::SampleUniform(stream, 0.0, 2.0),
                                core::SampleUniform(stream, -1.0, 1.0),
                                core::SampleUniform(stream, -0.1, 0.1)});
    }
    const Transform X_WR = math::MakePose({x, y, 0.0}, 0.1 * step, 0.02, -0.03);
    for (GestaltMap* map : {&wrapping, &plain}) {
      map->BeginCycle(x, y);
      map->Add(cloud, X_WR);
    }
    const GoodnessGrid& a = wrapping.Evaluate();
    const GoodnessGrid& b = plain.Evaluate();
    const int dx = static_cast<int>(std::lround((a.x0_m - b.x0_m) / 0.2));
    const int dy = static_cast<int>(std::lround((a.y0_m - b.y0_m) / 0.2));
    for (int iy = 0; iy < a.ny; ++iy) {
      for (int ix = 0; ix < a.nx; ++ix) {
        ASSERT_EQ(a.Cell(ix, iy), b.Cell(ix + dx, iy + dy)) << step << ": " << ix << ", " << iy;
        known += a.Cell(ix, iy).known ? 1 : 0;
      }
    }
  }
  EXPECT_GT(known, 5000);
}

TEST(GestaltMemoryTest, PointsThatAreNoGroundAreLeftOut) {
  GestaltMap map(HandParams());
  map.BeginCycle(kHandRover_m, kHandRover_m);
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  for (const math::Vector3& p :
       {math::Vector3(none, 0, 0), math::Vector3(0, endless, 0), math::Vector3(0, 0, -endless),
        math::Vector3(0, 0, none), math::Vector3(1e300, 0, 0), math::Vector3(0, 0, 10.1)}) {
    map.Add(OnePoint(p.x(), p.y(), p.z()), Transform::Identity());
  }
  EXPECT_EQ(CellsWithData(map), 0);
  map.Add(OnePoint(0.1, 0.1, 9.9), Transform::Identity());
  EXPECT_EQ(CellsWithData(map), 1);
}

// 10 m above or below R, not above or below the origin of the world.
TEST(GestaltMemoryTest, HeightCountsFromTheRover) {
  GestaltMap map(HandParams());
  map.BeginCycle(kHandRover_m, kHandRover_m);
  const Transform X_WR = math::MakePose({0.0, 0.0, 50.0}, 0.0, 0.0, 0.0);
  map.Add(OnePoint(0.1, 0.1, -50.0), X_WR);  // at the height of the origin
  map.Add(OnePoint(0.1, 0.1, 10.1), X_WR);
  map.Add(OnePoint(0.1, 0.1, -10.1), X_WR);
  EXPECT_EQ(CellsWithData(map), 0);
  map.Add(OnePoint(0.1, 0.1, 9.9), X_WR);
  map.Add(OnePoint(0.9, 0.1, -9.9), X_WR);
  EXPECT_EQ(CellsWithData(map), 2);
}

TEST(GestaltMemoryTest, FarAwayAndBackIsNoProblem) {
  GestaltMap map = MapOf(HandParams(), PointsOn(kWholeWindow, Level));
  for (const double far : {1e9, -1e300, 0.0}) {
    map.BeginCycle(far, -far);
    map.Add(PointsOn(kWholeWindow, Level), Transform::Identity());
    map.MarkObstacle(far, far, 0.3);
    EXPECT_EQ(map.Evaluate().cells.size(), 441U);
  }
  EXPECT_EQ(CellsWithData(map), 21 * 21);
}

// What is full takes no more; 65536 points of height 1 m keep their mean.
TEST(GestaltMemoryTest, CellsTakeSoManyPoints) {
  GestaltMap map(HandParams());
  map.BeginCycle(kHandRover_m, kHandRover_m);
  messages::PointCloud cloud;
  cloud.points_R.assign(65536, {0.1, 0.1, 1.0});
  map.Add(cloud, Transform::Identity());
  cloud.points_R.assign(65536, {0.1, 0.1, 3.0});
  map.Add(cloud, Transform::Identity());
  map.Evaluate();
  EXPECT_EQ(map.View().Cell(10, 10).elevation_m, 1.0);
}

TEST(GestaltMemoryTest, ClearForgetsAll) {
  GestaltMap map = MapOf(HandParams(), PointsOn(kWholeWindow, Level));
  map.MarkObstacle(0.1, 0.1, 0.5);
  map.Clear();
  for (const CellValue& cell : map.Evaluate().cells) {
    EXPECT_EQ(cell, (CellValue{11, 0, false}));
  }
  map.Add(PointsOn(kWholeWindow, Level), Transform::Identity());
  EXPECT_EQ(map.Evaluate().Cell(10, 10), (CellValue{255, 255, true}));
}

TEST(GestaltMemoryTest, WithoutARoverModelNothingIsKnown) {
  GestaltMapParams params = HandParams();
  params.rover.modelled = false;
  params.pairs.unknown_rovers = {7, 9};
  GestaltMap map = MapOf(params, PointsOn(kWholeWindow, Level));
  for (const CellValue& cell : map.Evaluate().cells) EXPECT_EQ(cell, (CellValue{7, 9, false}));
  EXPECT_EQ(map.Evaluate().At(1e6, 0.0), (CellValue{7, 9, false}));
}

TEST(GestaltMemoryTest, ViewShowsElevationAndGoodness) {
  GestaltMap map =
      MapOf(HandParams(),
            PointsOn({5, 15, 5, 15}, [](double x, double) { return x > 0.0 ? 0.05 : -0.05; }));
  map.Evaluate();
  const messages::MapView view = map.View();
  EXPECT_FALSE(view.Cell(4, 10).has_data);
  EXPECT_NEAR(view.Cell(9, 10).elevation_m, -0.05, 1e-12);
  EXPECT_NEAR(view.Cell(10, 10).elevation_m, 0.05, 1e-12);
  EXPECT_EQ(view.Cell(10, 10).goodness, 64);
  EXPECT_EQ(view.Cell(0, 0).goodness, 11);
  EXPECT_TRUE(view.Cell(10, 10).known);
}

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
