// Turning in place away from hazards.
#include <gtest/gtest.h>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

// Direction of each turn that answered a hazardous report, in order.
std::vector<int> AvoidanceTurns(const std::vector<Tick>& log) {
  std::vector<int> directions;
  for (const Tick& tick : log) {
    if (tick.has_report && tick.report != kClear && tick.turns()) {
      directions.push_back(tick.decision.motion.direction);
    }
  }
  return directions;
}

bool Drives(const Tick& tick) { return tick.drives(); }

TEST(Avoidance, TurnsInPlaceUntilNoHazardIsDetected) {
  DriveSetup setup;
  setup.hazards = Sequence({kLeftHazard, kLeftHazard, kLeftHazard});
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil(Drives));
  EXPECT_EQ(drive.scans(), 4);
  EXPECT_EQ(AvoidanceTurns(drive.log()), (std::vector{-1, -1, -1}));
  EXPECT_EQ(drive.log().back().estimate.distance_m, 0.0) << "turned on the spot";
}

TEST(Avoidance, TurnBetweenScansIsTheIncrementAsTheGyroMeasuresIt) {
  DriveSetup setup;
  setup.params.turn_increment_rad = math::DegToRad(15.0);
  setup.hazards = Sequence({kRightHazard, kRightHazard, kRightHazard, kRightHazard});
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil(Drives));
  const std::vector<std::size_t> scans = ScanTicks(drive.log());
  ASSERT_EQ(scans.size(), 5u);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double turned_rad = MotionBetween(drive.log(), scans[i - 1], scans[i]).turned_rad;
    ExpectEnds(turned_rad, setup.params.turn_increment_rad, setup.rover.tick_turn_rad());
  }
  const Tick& end = drive.log().back();
  EXPECT_NEAR(end.estimate.heading_rad, 0.94 * end.X_WR.heading_rad, kRounding);
}

TEST(Avoidance, LatchedTurnKeepsItsSideUntilClearAndAnotherFollowsEachScan) {
  const std::pair<TurnDirection, std::vector<int>> kTurns[] = {
      {TurnDirection::kLatched, {-1, -1, -1, -1, 1, 1}},
      {TurnDirection::kEachScan, {-1, 1, -1, 1, 1, -1}}};
  for (const auto& [turn_direction, turns] : kTurns) {
    DriveSetup setup;
    setup.params.turn_direction = turn_direction;
    setup.hazards = Sequence({kLeftHazard, kRightHazard, kCentreHazard, kRightHazard, kClear,
                              kRightHazard, kLeftHazard});
    Drive drive(setup);
    ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_EQ(AvoidanceTurns(drive.log()), turns);
  }
}

TEST(Avoidance, GivesUpAfterTheMeasuredTurnOfAWallOfHazards) {
  for (const HeadingRange range : {HeadingRange::kWrapped, HeadingRange::kUnbounded}) {
    for (const Stripes& stripes : {kLeftHazard, kCentreHazard, kRightHazard, kAllHazards}) {
      for (const double give_up_deg : {100.0, 360.0, 725.0}) {
        DriveSetup setup;
        setup.params.turn_give_up_rad = math::DegToRad(give_up_deg);
        setup.rover.heading_range = range;
        setup.hazards = Always(stripes);
        Drive drive(setup);
        ASSERT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
        const double turned_rad = MotionBetween(drive.log(), 0, drive.log().size() - 1).turned_rad;
        ExpectEnds(turned_rad, setup.params.turn_give_up_rad,
                   setup.params.turn_increment_rad + setup.rover.tick_turn_rad());
        EXPECT_EQ(drive.rover().estimate().distance_m, 0.0);
      }
    }
  }
}

TEST(Avoidance, GivesUpWhenTurnsThatFollowEachScanCancel) {
  DriveSetup setup;
  setup.params.turn_direction = TurnDirection::kEachScan;
  setup.hazards = [](const FakeRover&, int scan_number) {
    return scan_number % 2 == 0 ? kLeftHazard : kRightHazard;
  };
  Drive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
}

TEST(Avoidance, AClearScanStartsTheGiveUpAngleAnew) {
  DriveSetup setup;
  setup.params.turn_give_up_rad = math::DegToRad(90.0);
  setup.params.turn_increment_rad = math::DegToRad(20.0);
  // Three turns of 20 deg to the right, a clear scan, and three to the left, again and again.
  std::vector<Stripes> reports;
  for (int i = 0; i < 10; ++i) {
    for (const Stripes& stripes : {kLeftHazard, kLeftHazard, kLeftHazard, kClear, kRightHazard,
                                   kRightHazard, kRightHazard, kClear}) {
      reports.push_back(stripes);
    }
  }
  setup.hazards = Sequence(reports);
  Drive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

TEST(Avoidance, DrivesOnTowardsTheGoalAtOnceByDefault) {
  DriveSetup setup;
  setup.hazards = Sequence({kLeftHazard, kLeftHazard});
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil(Drives));
  // About 20 deg to the right of the goal's direction.
  EXPECT_GT(drive.log().back().decision.motion.curvature_per_m, 0.0);
}

TEST(Avoidance, ClearDistanceIsDrivenStraightAsMeasured) {
  for (const double clear_m : {0.04, 0.1, 0.2}) {
    SCOPED_TRACE(clear_m);
    DriveSetup setup;
    setup.params.clear_distance_m = clear_m;
    setup.hazards = Sequence({kLeftHazard, kLeftHazard, kLeftHazard});
    Drive drive(setup);
    ASSERT_TRUE(drive.StepUntil(
        [](const Tick& t) { return t.drives() && t.decision.motion.curvature_per_m != 0.0; }));
    const double straight_m = drive.log().back().estimate.distance_m;
    EXPECT_GE(straight_m, clear_m - kRounding);
    EXPECT_LE(straight_m, clear_m + 2.0 * setup.rover.tick_distance_m());
    const std::vector<std::size_t> scans = ScanTicks(drive.log());
    for (std::size_t i = 1; i < scans.size(); ++i) {
      EXPECT_LE(MotionBetween(drive.log(), scans[i - 1], scans[i]).driven_m,
                setup.params.scan_interval_m + setup.rover.tick_distance_m() + kRounding)
          << "looks on the way";
    }
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  }
}

TEST(Avoidance, HazardWhileClearingStartsANewTurn) {
  DriveSetup setup;
  setup.params.clear_distance_m = 0.3;
  setup.hazards = Sequence({kLeftHazard, kClear, kClear, kRightHazard});
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(AvoidanceTurns(drive.log()), (std::vector{-1, 1}));
}

TEST(Avoidance, HazardOnTheWayToFaceTheGoalIsAvoided) {
  DriveSetup setup;
  setup.start = {0.0, 0.0, math::DegToRad(150.0)};  // the goal is reached by turning right
  setup.hazards = Sequence({kClear, kRightHazard});
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(AvoidanceTurns(drive.log()), (std::vector{1}));
}

TEST(Avoidance, GoalReachedWhileDrivingClearOfAHazardStops) {
  DriveSetup setup;
  setup.params.clear_distance_m = 2.0;
  setup.goal = {1.0, 0.0};
  setup.start = {0.0, 0.0, math::DegToRad(10.5)};  // one turn to the right faces the goal
  setup.hazards = Sequence({kLeftHazard});
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_LE(drive.rover().estimate().distance_m, 1.0);
  EXPECT_LE(DistanceToGoal(drive.rover().estimate(), setup.goal), 0.1);
}

TEST(Avoidance, GoalReachedWhileTurningStops) {
  DriveSetup setup;
  setup.hazards = Always(kLeftHazard);
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.turns(); }));
  drive.UpdatePose({setup.goal.x_m, setup.goal.y_m + 0.05, 0.3});
  EXPECT_EQ(drive.Step().decision.status, NavigatorStatus::kArrived);
}

}  // namespace
}  // namespace rockyard::navigation
