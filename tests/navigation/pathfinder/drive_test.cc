// Driving to the goal without hazards: manoeuvres end by what is measured on board.
#include <gtest/gtest.h>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

double Bearing(const Tick& tick, const messages::Goal& goal) {
  return math::WrapAngle(std::atan2(goal.y_m - tick.estimate.y_m, goal.x_m - tick.estimate.x_m) -
                         tick.estimate.heading_rad);
}

TEST(Drive, ArrivesWhenTheBelievedPositionIsWithinTolerance) {
  DriveSetup setup;
  setup.start = {0.0, 0.3, 0.4};
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
  DriveSetup setup;
  setup.start = {0.0, 0.3, 0.4};
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
  DriveSetup setup;
  setup.hazards = Sequence({kClear, kClear, kLeftHazard, kLeftHazard});
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
  DriveSetup setup;
  setup.start = {0.0, -0.5, 0.5};
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
  DriveSetup setup;
  setup.start = {0.0, -0.5, 0.5};
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
  DriveSetup setup;
  setup.start = {7.55, 0.03, 2.0};
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
      DriveSetup setup;
      setup.goal = {-3.0, goal_y_m};
      setup.start = {0.0, 0.0, math::DegToRad(heading_deg)};
      setup.rover.heading_range = HeadingRange::kUnbounded;
      Drive drive(setup);
      ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.moves(); }));
      EXPECT_TRUE(drive.log().back().drives());
      EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    }
  }
}

TEST(Drive, ScansAfterEveryTurnIncrementOnTheWayToFaceTheGoal) {
  DriveSetup setup;
  setup.start = {0.0, 0.0, math::DegToRad(170.0)};
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
        DriveSetup setup;
        setup.goal = {distance_m, 0.0};
        setup.start = {0.0, 0.0, math::DegToRad(10.0 * i + 0.5)};
        setup.rover.heading_range = range;
        Drive drive(setup);
        EXPECT_EQ(drive.Run(20000), NavigatorStatus::kArrived);
      }
    }
  }
}

TEST(Drive, BlindRoverNeverScansAndArrives) {
  for (const double heading_rad : {0.0, 0.7, -2.5}) {
    DriveSetup setup;
    setup.start = {0.0, 0.2, heading_rad};
    setup.hazards = Always(kAllHazards);
    setup.sensor = HazardSensor::kOff;
    Drive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_TRUE(ScanTicks(drive.log()).empty());
  }
}

}  // namespace
}  // namespace rockyard::navigation
