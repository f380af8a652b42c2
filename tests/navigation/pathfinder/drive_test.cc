// Driving to the goal without hazards: manoeuvres end by what is measured on board.

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

using messages::Goal;

double Bearing(const Tick& tick, const messages::Goal& goal) {
  return math::WrapAngle(std::atan2(goal.y_m - tick.estimate.y_m, goal.x_m - tick.estimate.x_m) -
                         tick.estimate.heading_rad);
}

TEST(Drive, ArrivesWhenTheBelievedPositionIsWithinTolerance) {
  DriveSetup setup{.start = {0.0, 0.3, 0.4}};
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const std::vector<Tick>& log = drive.log();
  for (const Tick& tick : log) {
    const bool at_goal = DistanceToGoal(tick.estimate, setup.goal) <= setup.params.goal_tolerance_m;
    EXPECT_EQ(at_goal, tick.decision.status == NavigatorStatus::kArrived) << tick.time_s;
  }
  // The odometer reads 5 % long, so the true rover stands short of the goal: belief decided.
  EXPECT_LT(log.back().X_WR.x_m, 7.6 / setup.rover.odometer_scale + 0.05);
}

TEST(Drive, ScansAtRestBeforeTheFirstMove) {
  Drive drive({});
  EXPECT_TRUE(drive.Step().decision.looks());
  const Tick& second = drive.Step();
  EXPECT_TRUE(second.has_report);
  EXPECT_EQ(second.estimate.distance_m, 0.0);
  EXPECT_TRUE(second.drives());
}

TEST(Drive, ScansAfterEveryWheelRadiusOfMeasuredDriving) {
  DriveSetup setup{.start = {0.0, 0.3, 0.4}};
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const std::vector<std::size_t> scans = ScanTicks(drive.log());
  ASSERT_GT(scans.size(), 100u);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double driven_m = MotionBetween(drive.log(), scans[i - 1], scans[i]).driven_m;
    ExpectEnds(driven_m, 0.065, setup.rover.tick_distance_m());
  }
}

TEST(Drive, StandsStillWhileItScans) {
  DriveSetup setup{.hazards = Sequence({kClear, kClear, kLeftHazard, kLeftHazard})};
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const std::vector<Tick>& log = drive.log();
  for (std::size_t i = 0; i + 1 < log.size(); ++i) {
    if (!log[i].decision.looks()) continue;
    EXPECT_EQ(log[i].X_WR.x_m, log[i + 1].X_WR.x_m);
    EXPECT_FALSE(log[i + 1].decision.looks()) << "a report answers a scan";
  }
}

TEST(Drive, SteersTowardsTheGoalWheneverAReportIsClear) {
  DriveSetup setup{.start = {0.0, -0.5, 0.5}};
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  for (const Tick& tick : drive.log()) {
    if (!tick.has_report) continue;
    const double bearing_rad = Bearing(tick, setup.goal);
    if (std::abs(bearing_rad) > setup.params.point_turn_bearing_rad) continue;
    ASSERT_TRUE(tick.drives());
    EXPECT_EQ(tick.decision.motion.direction, 1);
    EXPECT_EQ(tick.decision.motion.curvature_per_m, CurvatureToGoal(bearing_rad, setup.params));
  }
}

TEST(Drive, KeepsItsCommandWhileNothingIsMeasured) {
  DriveSetup setup{.start = {0.0, -0.5, 0.5}};
  Drive drive(setup);
  drive.Step();
  const NavigatorDecision driving = drive.Step().decision;
  for (int i = 0; i < 1000; ++i) {
    const NavigatorDecision held = drive.HeldDecision(0.1 + 0.05 * i);
    EXPECT_EQ(held.status, NavigatorStatus::kDriving);
    EXPECT_FALSE(held.looks());
    EXPECT_EQ(held.motion.kind, driving.motion.kind);
    EXPECT_EQ(held.motion.curvature_per_m, driving.motion.curvature_per_m);
  }
}

TEST(Drive, StartingAtTheGoalIsArrival) {
  DriveSetup setup{.start = {7.55, 0.03, 2.0}};
  Drive drive(setup);
  ASSERT_EQ(drive.Run(100), NavigatorStatus::kArrived);
  EXPECT_EQ(drive.rover().estimate().distance_m, 0.0);
}

TEST(Drive, TurnsInPlaceWhenTheGoalIsBehind) {
  for (const double heading_deg : {100.0, 135.0, 170.0, -100.0, -135.0, -170.0}) {
    SCOPED_TRACE(heading_deg);
    DriveSetup setup;
    setup.params.point_turn_bearing_rad = math::DegToRad(90.0);
    setup.start = {0.0, 0.0, math::DegToRad(heading_deg)};
    Drive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.moves(); }));
    EXPECT_TRUE(drive.log().back().turns());
    EXPECT_EQ(drive.log().back().decision.motion.direction, heading_deg > 0.0 ? -1 : 1);
    ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.drives(); }));
    EXPECT_LE(std::abs(Bearing(drive.log().back(), setup.goal)),
              setup.params.point_turn_bearing_rad);
    EXPECT_EQ(drive.log().back().estimate.distance_m, 0.0);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  }
}

// The arc to a goal at distance d and bearing b has radius d / (2 sin b); below the tightest radius
// the rover would circle the goal for ever.
TEST(Drive, TurnsInPlaceWhenTheGoalLiesInsideTheTightestCircle) {
  DriveSetup setup;
  const double bearing_rad = math::DegToRad(60.0);
  const double reach_m = 2.0 * setup.params.tight_arc_radius_m * std::sin(bearing_rad);
  for (const bool inside : {true, false}) {
    SCOPED_TRACE(inside);
    const double distance_m = inside ? 0.9 * reach_m : 1.1 * reach_m;
    setup.start = {setup.goal.x_m - distance_m, setup.goal.y_m, -bearing_rad};
    Drive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.moves(); }));
    EXPECT_EQ(drive.log().back().turns(), inside);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  }
}

TEST(Drive, BearingToTheGoalIsTheShortWayRound) {
  // Nearly ahead across the cut of the angles: drive on an arc, do not turn round.
  for (const double goal_y_m : {-0.3, 0.3}) {
    for (const double heading_deg : {170.0, -170.0, 530.0, -530.0}) {
      SCOPED_TRACE(heading_deg);
      DriveSetup setup{.goal = {-3.0, goal_y_m},
                       .start = {0.0, 0.0, math::DegToRad(heading_deg)},
                       .rover = {.heading_range = HeadingRange::kUnbounded}};
      Drive drive(setup);
      ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.moves(); }));
      EXPECT_TRUE(drive.log().back().drives());
      EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    }
  }
}

TEST(Drive, ScansAfterEveryTurnIncrementOnTheWayToFaceTheGoal) {
  DriveSetup setup{.start = {0.0, 0.0, math::DegToRad(170.0)}};
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.drives(); }));
  const std::vector<std::size_t> scans = ScanTicks(drive.log());
  ASSERT_GE(scans.size(), 2u);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    EXPECT_LE(MotionBetween(drive.log(), scans[i - 1], scans[i]).turned_rad,
              setup.params.turn_increment_rad + setup.rover.tick_turn_rad() + kRounding);
  }
}

TEST(Drive, ArrivesFromEveryBearingAndDistance) {
  for (const HeadingRange range : {HeadingRange::kWrapped, HeadingRange::kUnbounded}) {
    for (int i = 0; i < 36; ++i) {
      for (const double distance_m : {0.15, 0.4, 1.0, 3.0}) {
        SCOPED_TRACE(testing::Message() << "heading " << 10 * i << " deg, " << distance_m << " m");
        DriveSetup setup{.goal = {distance_m, 0.0},
                         .start = {0.0, 0.0, math::DegToRad(10.0 * i + 0.5)},
                         .rover = {.heading_range = range}};
        Drive drive(setup);
        EXPECT_EQ(drive.Run(20000), NavigatorStatus::kArrived);
      }
    }
  }
}

TEST(Drive, BlindRoverNeverScansAndArrives) {
  for (const double heading_rad : {0.0, 0.7, -2.5}) {
    DriveSetup setup{.start = {0.0, 0.2, heading_rad},
                     .hazards = Always(kAllHazards),
                     .sensor = HazardSensor::kOff};
    Drive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_TRUE(ScanTicks(drive.log()).empty());
  }
}

// The behaviour controller on its way: another goal; and operators who correct its estimate while a
// manoeuvre is under way, where what has been measured of the manoeuvre stays measured.

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
  DriveSetup setup{.rover = TrueRover(), .hazards = Always(kLeftHazard)};
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
    DriveSetup setup{.params = {.vehicle_reaction = {.max_repeats = 3,
                                                     .on_exhausted = ReactionsExhausted::kGiveUp}},
                     .felt = FeltBeyond(0.5)};
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
  DriveSetup setup{.hazards = Always(kLeftHazard)};
  Drive drive(setup);
  while (drive.log().empty() || drive.log().back().decision.status == NavigatorStatus::kDriving) {
    ASSERT_LT(drive.log().size(), 5000u);
    drive.Step();
    if (drive.log().size() % 17 == 0) drive.UpdatePose(Shifted(drive.rover().estimate(), 2.0));
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
