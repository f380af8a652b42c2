// Another goal for GESTALT on its way; and corrections of its estimate, which move the goal and
// leave map and manoeuvres where they are.
#include <gtest/gtest.h>

#include <cmath>

#include "drive.h"

namespace rockyard::navigation {
namespace {

using messages::LookDirection;

TEST(GestaltGoal, TheStepUnderWayEndsAsItWouldHave) {
  GestaltSetup setup = TrueSetup();
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.X_WR.x_m > 0.1; }));
  drive.SetGoal({0.0, 4.0}, GoalChange::kNext);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); }));
  EXPECT_NEAR(drive.rover().estimate().distance_m, setup.params.drive.step_m,
              setup.rover.tick_distance_m());
  EXPECT_EQ(drive.rover().estimate().y_m, 0.0) << "straight on";
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_LE(DistanceToGoal(drive.rover().estimate(), {0.0, 4.0}),
            setup.params.waypoints.goal_tolerance_m);
  EXPECT_EQ(drive.navigator().view()->goal.y_m, 4.0);
}

TEST(GestaltGoal, KeepsTheMap) {
  GestaltSetup setup = TrueSetup();
  setup.height = Blocks({{2.0, 2.4, -2.0, 2.0}});
  GestaltDrive kept(setup);
  GestaltDrive told(setup);
  const auto second_look = [](GestaltDrive& drive) {
    drive.StepUntil(&GestaltTick::chooses);
    return drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); });
  };
  ASSERT_TRUE(second_look(kept));
  ASSERT_TRUE(second_look(told));
  told.SetGoal({5.0, 0.5}, GoalChange::kNext);
  kept.Step();
  told.Step();
  EXPECT_TRUE(HoldSameData(kept.navigator().view()->map, told.navigator().view()->map));
  EXPECT_EQ(told.navigator().view()->goal.y_m, 0.5);
}

// Cycles that a rover in a pit begins until it gives up, told of a goal half way through.
int LooksInAPit(GoalChange change) {
  GestaltSetup setup;
  setup.height = Blocks(Pit());
  setup.params.drive.max_fruitless_cycles = 20;
  GestaltDrive drive(setup);
  while (drive.Looks(LookDirection::kAhead) < 15) drive.Step();
  drive.SetGoal({6.0, 0.0}, change);  // farther away than the first
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  return drive.Looks(LookDirection::kAhead);
}

// The pit allows for no progress beyond the first metre, so that 20 to 30 looks end the search for
// one goal (GestaltEndings).
TEST(GestaltGoal, ProgressTowardsTheNextGoalCountsAnew) {
  EXPECT_GE(LooksInAPit(GoalChange::kNext), 35);
  EXPECT_LE(LooksInAPit(GoalChange::kMoved), 30);
}

// Turns in place before a rover that sees nothing drives into the unknown: four of 90 deg make a
// search (GestaltEndings), and a next goal after two of them begins another.
int TurnsBeforeTheFirstDrive(GoalChange change) {
  GestaltSetup setup = TrueSetup();
  setup.range.range_m = 0.2;
  setup.goal = {4.0, 1.0};
  GestaltDrive drive(setup);
  int turns = 0;
  int side = 0;
  bool turned = false;
  for (int i = 0; i < 20000 && !drive.Step().drives(); ++i) {
    const bool turning = drive.log().back().turns();
    if (turning) side = drive.log().back().decision.motion.direction;
    if (turned && !turning && ++turns == 2) drive.SetGoal({4.0, 1.5}, change);
    turned = turning;
  }
  // After half a turn to the left the next goal lies on the right.
  EXPECT_EQ(side, change == GoalChange::kNext ? -1 : +1);
  return turns;
}

TEST(GestaltGoal, ASearchBeginsAnewWithTheNextGoal) {
  EXPECT_EQ(TurnsBeforeTheFirstDrive(GoalChange::kMoved), 4);
  EXPECT_EQ(TurnsBeforeTheFirstDrive(GoalChange::kNext), 6);
}

// Whether the log ends with the first tick of a back-off: from one way to the other without a look.
bool BeginsBackOff(const std::vector<GestaltTick>& log) {
  if (log.size() < 2) return false;
  const GestaltTick& before = log[log.size() - 2];
  return before.drives() && log.back().drives() &&
         before.decision.motion.direction != log.back().decision.motion.direction;
}

// A wall across the whole way that no camera sees: as many touches as are borne without progress,
// and with the next goal as many once more.
TEST(GestaltGoal, FeltHazardsCountAnewWithTheNextGoal) {
  for (const bool next : {false, true}) {
    GestaltSetup setup = TrueSetup();
    setup.felt = FeltBeyond(1.0);
    setup.params.drive.max_felt = 3;
    setup.params.drive.progress_m = 2.0;  // more than the wall allows for
    GestaltDrive drive(setup);
    int felt = 0;
    for (int i = 0; i < 50000; ++i) {
      if (drive.Step().decision.status != NavigatorStatus::kDriving) break;
      if (BeginsBackOff(drive.log()) && ++felt == 2 && next) {
        drive.SetGoal({5.0, 0.4}, GoalChange::kNext);
      }
    }
    EXPECT_EQ(drive.log().back().decision.status, NavigatorStatus::kGaveUp);
    EXPECT_EQ(felt, next ? 5 : 3);
  }
}

// What it felt outlives the first cycle to the next goal: after a pose update, which clears the
// map, the place is an obstacle still, at its distance from the rover.
TEST(GestaltGoal, FeltPlacesStay) {
  GestaltSetup setup = TrueSetup();
  setup.felt = FeltOnceBeyond(
      1.2, {messages::VehicleHazardKind::kArticulation, messages::HazardSide::kAhead});
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::backs));
  const double place_m = drive.log().back().X_WR.x_m + 0.5 * setup.params.map.rover.length_m;
  drive.SetGoal({-5.0, 0.0}, GoalChange::kNext);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::chooses));
  const messages::PoseEstimate& e = drive.rover().estimate();
  drive.UpdatePose({e.x_m, e.y_m, e.heading_rad});
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::chooses));
  const messages::MapView& map = drive.navigator().view()->map;
  ASSERT_TRUE(place_m > map.x0_m && place_m < map.x0_m + map.nx * map.xstep_m);
  ASSERT_TRUE(map.y0_m < 0.0 && 0.0 < map.y0_m + map.ny * map.ystep_m);
  EXPECT_TRUE(CellAt(drive, place_m, 0.0).known);
  EXPECT_EQ(GoodnessAt(drive, place_m, 0.0), 0);
}

// A rover among blocks, after some steps.
GestaltSetup AmongBlocks() {
  GestaltSetup setup = TrueSetup();
  setup.height = Blocks({{1.8, 2.1, -0.4, 0.3}, {3.0, 3.2, 0.3, 1.2}});
  return setup;
}

bool HalfWay(const GestaltTick& tick) { return tick.drives() && tick.estimate.distance_m > 0.5; }

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
  GestaltDrive twin(AmongBlocks());
  GestaltDrive corrected(AmongBlocks());
  ASSERT_TRUE(twin.StepUntil(HalfWay));
  ASSERT_TRUE(corrected.StepUntil(HalfWay));
  const messages::MapView before = corrected.navigator().view()->map;
  corrected.Correct(kCorrection);
  ASSERT_TRUE(twin.StepUntil(&GestaltTick::chooses));
  ASSERT_TRUE(corrected.StepUntil(&GestaltTick::chooses));
  EXPECT_EQ(corrected.log().size(), twin.log().size()) << "the step ends where it would have";
  EXPECT_TRUE(HoldSameData(corrected.navigator().view()->map, twin.navigator().view()->map));
  EXPECT_GT(CellsThatStay(before, corrected.navigator().view()->map),
            CellsWithData(before) * 9 / 10);
}

// Operators who move the rover by hand do clear it (the other kind of jump).
TEST(GestaltCorrection, AMoveByHandClearsTheMap) {
  GestaltDrive moved(AmongBlocks());
  ASSERT_TRUE(moved.StepUntil(HalfWay));
  const messages::MapView before = moved.navigator().view()->map;
  moved.UpdatePose(kCorrection);
  ASSERT_TRUE(moved.StepUntil(&GestaltTick::chooses));
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
