// Another goal for the behaviour controller on its way.
#include <gtest/gtest.h>

#include <cmath>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

using messages::Goal;

FakeRoverConfig TrueRover() { return {.gyro_scale = 1.0, .odometer_scale = 1.0}; }

TEST(PathfinderGoal, DrivesToTheNextGoal) {
  for (const Goal next : {Goal{2.0, 3.0}, Goal{-3.0, 0.5}, Goal{0.0, -4.0}}) {
    DriveSetup setup;
    Drive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.estimate.x_m > 2.0; }));
    drive.SetGoal(next, GoalChange::kNext);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_LE(DistanceToGoal(drive.rover().estimate(), next), setup.params.goal_tolerance_m);
  }
}

// The turn away from a hazard goes on to its increment, whatever the goal is by then.
TEST(PathfinderGoal, AnAvoidanceUnderWayGoesOn) {
  DriveSetup setup;
  setup.rover = TrueRover();
  setup.hazards = Always(kLeftHazard);
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.turns(); }));
  const std::size_t first = drive.log().size() - 1;
  drive.SetGoal({0.0, 5.0}, GoalChange::kNext);  // on the side of the hazard
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.decision.looks(); }));
  const MeasuredMotion turn = MotionBetween(drive.log(), first, drive.log().size() - 1);
  EXPECT_GE(turn.turned_rad, setup.params.turn_increment_rad - 1e-9);
  EXPECT_LE(turn.turned_rad, setup.params.turn_increment_rad + setup.rover.tick_turn_rad() + 1e-9);
  EXPECT_EQ(drive.log().back().X_WR.heading_rad < 0.0, true) << "to the right";
}

// A turn in place towards a goal behind goes on while that is only located better, and ends with
// the next goal where that lies ahead.
TEST(PathfinderGoal, TurnsOnTowardsAGoalThatMovedAndAsksAnewForTheNext) {
  for (const GoalChange change : {GoalChange::kMoved, GoalChange::kNext}) {
    DriveSetup setup;
    setup.rover = TrueRover();
    setup.goal = {-5.0, 0.1};
    Drive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.turns(); }));
    const double heading_rad = math::DegToRad(60.0);
    ASSERT_TRUE(drive.StepUntil(
        [&](const Tick& t) { return t.turns() && t.estimate.heading_rad > heading_rad; }));
    // 60 deg to the left of the heading, less than asks for a turn in place.
    drive.SetGoal({-2.5, 4.33}, change);
    ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.drives(); }));
    const double bearing_rad = math::DegToRad(120.0) - drive.log().back().estimate.heading_rad;
    if (change == GoalChange::kMoved) {
      EXPECT_LT(std::abs(bearing_rad), math::DegToRad(6.0));
    } else {
      EXPECT_GT(bearing_rad, math::DegToRad(40.0));
    }
  }
}

// Every reaction to a touch counts until the goal has come nearer. At most max_repeats in a row,
// and as many again on the way to the next goal, though that is farther away.
TEST(PathfinderGoal, ReactionsCountAnewWithTheNextGoal) {
  for (const GoalChange change : {GoalChange::kMoved, GoalChange::kNext}) {
    DriveSetup setup;
    setup.params.vehicle_reaction.max_repeats = 3;
    setup.params.vehicle_reaction.on_exhausted = ReactionsExhausted::kGiveUp;
    setup.felt = [](const FakeRover& rover) -> std::optional<messages::VehicleHazard> {
      if (rover.X_WR().x_m < 0.5) return std::nullopt;
      return messages::VehicleHazard{messages::VehicleHazardKind::kContact,
                                     messages::HazardSide::kAhead};
    };
    Drive drive(setup);
    int reactions = 0;
    bool backed = false;
    for (int i = 0; i < 50000; ++i) {
      const Tick& tick = drive.Step();
      if (tick.decision.status != NavigatorStatus::kDriving) break;
      const bool backs = tick.drives() && tick.decision.motion.direction < 0;
      if (backs && !backed && ++reactions == 2) drive.SetGoal({9.0, 0.0}, change);
      backed = backs;
    }
    EXPECT_EQ(drive.log().back().decision.status, NavigatorStatus::kGaveUp);
    EXPECT_EQ(reactions, change == GoalChange::kNext ? 5 : 3);
  }
}

}  // namespace
}  // namespace rockyard::navigation
