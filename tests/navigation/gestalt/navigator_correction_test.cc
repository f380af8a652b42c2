// Corrections of the estimate: they move the goal, and leave map and manoeuvres where they are.
#include <gtest/gtest.h>

#include "drive.h"

namespace rockyard::navigation {
namespace {

// A rover among blocks, after some steps.
GestaltSetup AmongBlocks() {
  GestaltSetup setup = TrueSetup();
  setup.height = Blocks({{1.8, 2.1, -0.4, 0.3}, {3.0, 3.2, 0.3, 1.2}});
  return setup;
}

constexpr messages::PoseUpdate kCorrection{0.8, -0.5, 0.2};

// Cells of one view that hold data and keep their place and height in a later one.
int CellsThatStay(const messages::MapView& before, const messages::MapView& after) {
  int stay = 0;
  for (int iy = 0; iy < before.ny; ++iy) {
    for (int ix = 0; ix < before.nx; ++ix) {
      if (!before.Cell(ix, iy).has_data) continue;
      const double x_m = before.x0_m + (ix + 0.5) * before.xstep_m - after.x0_m;
      const double y_m = before.y0_m + (iy + 0.5) * before.ystep_m - after.y0_m;
      const int jx = static_cast<int>(std::floor(x_m / after.xstep_m));
      const int jy = static_cast<int>(std::floor(y_m / after.ystep_m));
      if (jx < 0 || jy < 0 || jx >= after.nx || jy >= after.ny) continue;
      const messages::MapCellView& cell = after.Cell(jx, jy);
      stay += cell.has_data && std::abs(cell.elevation_m - before.Cell(ix, iy).elevation_m) < 1e-9;
    }
  }
  return stay;
}

int CellsWithData(const messages::MapView& map) {
  int count = 0;
  for (const messages::MapCellView& cell : map.cells) count += cell.has_data;
  return count;
}

// Half-way through a step the rover is told that it is elsewhere. Its twin is told nothing. What it
// had seen stays, and a second look at the same ground adds no second picture of it.
TEST(GestaltCorrection, NeitherClearsNorSmearsTheMap) {
  const auto halfway = [](const GestaltTick& tick) {
    return tick.drives() && tick.estimate.distance_m > 0.5;
  };
  GestaltDrive twin(AmongBlocks());
  GestaltDrive corrected(AmongBlocks());
  ASSERT_TRUE(twin.StepUntil(halfway));
  ASSERT_TRUE(corrected.StepUntil(halfway));
  const messages::MapView before = corrected.navigator().view()->map;
  corrected.Correct(kCorrection);
  const auto decides = [](const GestaltTick& tick) { return tick.has_cloud && tick.moves(); };
  ASSERT_TRUE(twin.StepUntil(decides));
  ASSERT_TRUE(corrected.StepUntil(decides));
  EXPECT_EQ(corrected.log().size(), twin.log().size()) << "the step ends where it would have";
  EXPECT_TRUE(HoldSameData(corrected.navigator().view()->map, twin.navigator().view()->map));
  EXPECT_GT(CellsThatStay(before, corrected.navigator().view()->map),
            CellsWithData(before) * 9 / 10);
}

// Operators who move the rover by hand do clear it (the other kind of jump).
TEST(GestaltCorrection, AMoveByHandClearsTheMap) {
  GestaltDrive moved(AmongBlocks());
  ASSERT_TRUE(moved.StepUntil(
      [](const GestaltTick& tick) { return tick.drives() && tick.estimate.distance_m > 0.5; }));
  const messages::MapView before = moved.navigator().view()->map;
  moved.UpdatePose(kCorrection);
  ASSERT_TRUE(
      moved.StepUntil([](const GestaltTick& tick) { return tick.has_cloud && tick.moves(); }));
  EXPECT_LT(CellsThatStay(before, moved.navigator().view()->map), CellsWithData(before) / 2);
}

// The rover ends where the goal is in the corrected frame, not where it was before.
TEST(GestaltCorrection, MovesTheGoal) {
  GestaltSetup setup = TrueSetup();
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(
      [](const GestaltTick& tick) { return tick.drives() && tick.estimate.distance_m > 1.0; }));
  const math::Pose2 truth = drive.rover().X_WR();
  // It is told that it is 2 m further to the right and faces 0.2 rad to the left.
  drive.Correct({truth.x_m, truth.y_m - 2.0, truth.heading_rad + 0.2});
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const messages::PoseEstimate& end = drive.rover().estimate();
  EXPECT_LT(std::hypot(end.x_m - setup.goal.x_m, end.y_m - setup.goal.y_m),
            setup.params.waypoints.goal_tolerance_m + 1e-9);
  // In the world: the goal lies to the left of where it was, turned by the error of the heading.
  EXPECT_GT(drive.rover().X_WR().y_m, 0.8);
}

// A turn in place ends after the angle that was measured, corrected or not.
TEST(GestaltCorrection, ATurnUnderWayEndsAsItWouldHave) {
  const auto turned = [](bool correct) {
    GestaltSetup setup = TrueSetup();
    setup.height = Blocks({{0.7, 1.0, -3.0, 3.0}});
    setup.params.drive.rear_cameras = false;
    setup.params.drive.backward_arcs = BackwardArcs::kLastResort;
    GestaltDrive drive(setup);
    EXPECT_TRUE(drive.StepUntil([](const GestaltTick& tick) { return tick.turns(); }));
    for (int i = 0; i < 10; ++i) drive.Step();
    if (correct)
      drive.Correct({0.1, 0.2, math::WrapAngle(drive.rover().estimate().heading_rad + 1.0)});
    EXPECT_TRUE(drive.StepUntil([](const GestaltTick& tick) { return tick.decision.looks(); }));
    return drive.rover().X_WR().heading_rad;
  };
  EXPECT_NEAR(turned(true), turned(false), 1e-9);
}

}  // namespace
}  // namespace rockyard::navigation
