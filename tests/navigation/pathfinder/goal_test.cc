// The behaviour controller on its way: another goal; and operators who correct its estimate while a
// manoeuvre is under way, where what has been measured of the manoeuvre stays measured.
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
  ExpectEnds(turn.turned_rad, setup.params.turn_increment_rad, setup.rover.tick_turn_rad());
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
    setup.felt = FeltBeyond(0.5);
    Drive drive(setup);
    int reactions = 0;
    bool backed = false;
    for (int i = 0; i < 50000; ++i) {
      const Tick& tick = drive.Step();
      if (tick.decision.status != NavigatorStatus::kDriving) break;
      if (tick.backs() && !backed && ++reactions == 2) drive.SetGoal({9.0, 0.0}, change);
      backed = tick.backs();
    }
    EXPECT_EQ(drive.log().back().decision.status, NavigatorStatus::kGaveUp);
    EXPECT_EQ(reactions, change == GoalChange::kNext ? 5 : 3);
  }
}

messages::PoseUpdate Shifted(const messages::PoseEstimate& estimate, double jump_rad) {
  return {estimate.x_m + 0.4, estimate.y_m - 0.7, math::WrapAngle(estimate.heading_rad + jump_rad)};
}

// True turn of the rover over a log, in the gyro's scale.
double TurnedByGyro(const std::vector<Tick>& log, double gyro_scale) {
  double turned_rad = 0.0;
  for (std::size_t i = 0; i + 1 < log.size(); ++i) {
    turned_rad += gyro_scale * std::abs(log[i + 1].X_WR.heading_rad - log[i].X_WR.heading_rad);
  }
  return turned_rad;
}

TEST(PoseUpdate, DoesNotChangeTheAngleOfATurnUnderWay) {
  for (const Stripes& stripes : {kLeftHazard, kRightHazard}) {
    for (const double jump_rad : {0.0, 0.3, -0.3, 1.5, -1.5, 3.1}) {
      SCOPED_TRACE(jump_rad);
      DriveSetup setup;
      setup.params.turn_increment_rad = math::DegToRad(40.0);
      setup.hazards = Always(stripes);
      Drive drive(setup);
      for (int i = 0; i < 12; ++i) drive.Step();
      ASSERT_TRUE(drive.log().back().turns());
      drive.UpdatePose(Shifted(drive.rover().estimate(), jump_rad));
      ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.decision.looks(); }, 200));
      const double turned_rad = TurnedByGyro(drive.log(), setup.rover.gyro_scale);
      ExpectEnds(turned_rad, setup.params.turn_increment_rad, setup.rover.tick_turn_rad());
    }
  }
}

TEST(PoseUpdate, DoesNotChangeTheGiveUpAngle) {
  DriveSetup setup;
  setup.hazards = Always(kLeftHazard);
  Drive drive(setup);
  while (drive.log().empty() || drive.log().back().decision.status == NavigatorStatus::kDriving) {
    ASSERT_LT(drive.log().size(), 5000u);
    drive.Step();
    if (drive.log().size() % 17 == 0) {
      drive.UpdatePose(Shifted(drive.rover().estimate(), 2.0));
    }
  }
  EXPECT_EQ(drive.log().back().decision.status, NavigatorStatus::kGaveUp);
  const double turned_rad = TurnedByGyro(drive.log(), setup.rover.gyro_scale);
  ExpectEnds(turned_rad, setup.params.turn_give_up_rad,
             setup.params.turn_increment_rad + setup.rover.tick_turn_rad());
}

TEST(PoseUpdate, DoesNotChangeTheDistanceBetweenScans) {
  DriveSetup setup;
  Drive drive(setup);
  for (int i = 0; i < 2000; ++i) {
    drive.Step();
    if (i == 150) drive.UpdatePose({0.2, 0.5, -0.4});
    if (drive.log().back().decision.status != NavigatorStatus::kDriving) break;
  }
  const std::vector<std::size_t> scans = ScanTicks(drive.log());
  ASSERT_GT(scans.size(), 50u);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double driven_m =
        drive.log()[scans[i]].estimate.distance_m - drive.log()[scans[i - 1]].estimate.distance_m;
    ExpectEnds(driven_m, setup.params.scan_interval_m, setup.rover.tick_distance_m());
  }
}

TEST(PoseUpdate, DoesNotChangeTheStraightDriveAfterATurn) {
  DriveSetup setup;
  setup.params.clear_distance_m = 0.2;
  setup.hazards = Sequence({kLeftHazard, kLeftHazard, kLeftHazard});
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.estimate.distance_m > 0.03; }));
  drive.UpdatePose({0.4, -0.6, -1.2});
  ASSERT_TRUE(drive.StepUntil(
      [](const Tick& t) { return t.drives() && t.decision.motion.curvature_per_m != 0.0; }));
  EXPECT_GE(drive.log().back().estimate.distance_m, 0.2 - kRounding);
  EXPECT_LE(drive.log().back().estimate.distance_m, 0.2 + 2.0 * setup.rover.tick_distance_m());
}

TEST(PoseUpdate, SteersByTheNewEstimate) {
  DriveSetup setup;
  setup.start = {0.0, 0.0, 0.4};  // the goal lies to the right
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.drives(); }));
  EXPECT_LT(drive.log().back().decision.motion.curvature_per_m, 0.0);
  drive.UpdatePose({0.0, 0.0, -0.4});  // and now to the left
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.has_report; }));
  EXPECT_GT(drive.log().back().decision.motion.curvature_per_m, 0.0);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

TEST(PoseUpdate, DuringATurnTowardsTheGoalEndsFacingTheGoal) {
  for (const double heading_rad : {1.9, -1.9, 3.0}) {
    DriveSetup setup;
    setup.start = {0.0, 0.0, math::DegToRad(160.0)};
    Drive drive(setup);
    for (int i = 0; i < 8; ++i) drive.Step();
    ASSERT_TRUE(drive.log().back().turns());
    drive.UpdatePose({0.0, 0.0, heading_rad});
    EXPECT_EQ(drive.Run(20000), NavigatorStatus::kArrived);
  }
}

}  // namespace
}  // namespace rockyard::navigation
