// Another goal for GESTALT on its way.
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
    drive.StepUntil([](const GestaltTick& t) { return t.has_cloud && t.moves(); });
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
  setup.height = Blocks({{1.2, 1.6, -1.6, 1.6},
                         {-1.6, -1.2, -1.6, 1.6},
                         {-1.6, 1.6, 1.2, 1.6},
                         {-1.6, 1.6, -1.6, -1.2}});
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
  bool turned = false;
  for (int i = 0; i < 20000 && !drive.Step().drives(); ++i) {
    const bool turning = drive.log().back().turns();
    if (turned && !turning && ++turns == 2) drive.SetGoal({4.0, 1.5}, change);
    turned = turning;
  }
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
    setup.felt = [](const FakeRover& rover) -> std::optional<messages::VehicleHazard> {
      if (rover.X_WR().x_m < 1.0) return std::nullopt;
      return messages::VehicleHazard{messages::VehicleHazardKind::kContact,
                                     messages::HazardSide::kAhead};
    };
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
  bool felt = false;
  setup.felt = [&](const FakeRover& rover) -> std::optional<messages::VehicleHazard> {
    if (felt || rover.X_WR().x_m < 1.2) return std::nullopt;
    felt = true;
    return messages::VehicleHazard{messages::VehicleHazardKind::kArticulation,
                                   messages::HazardSide::kAhead};
  };
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(
      [](const GestaltTick& t) { return t.drives() && t.decision.motion.direction < 0; }));
  const double place_m = drive.log().back().X_WR.x_m + 0.5 * setup.params.map.rover.length_m;
  drive.SetGoal({-5.0, 0.0}, GoalChange::kNext);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.has_cloud && t.moves(); }));
  const messages::PoseEstimate& e = drive.rover().estimate();
  drive.UpdatePose({e.x_m, e.y_m, e.heading_rad});
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.has_cloud && t.moves(); }));
  const messages::MapView& map = drive.navigator().view()->map;
  const int ix = static_cast<int>(std::floor((place_m - map.x0_m) / map.xstep_m));
  const int iy = static_cast<int>(std::floor((0.0 - map.y0_m) / map.ystep_m));
  ASSERT_TRUE(ix >= 0 && ix < map.nx && iy >= 0 && iy < map.ny);
  EXPECT_TRUE(map.Cell(ix, iy).known);
  EXPECT_EQ(map.Cell(ix, iy).goodness, 0);
}

}  // namespace
}  // namespace rockyard::navigation
