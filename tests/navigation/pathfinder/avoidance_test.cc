// Turning in place away from hazards.

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
  DriveSetup setup{.hazards = Sequence({kLeftHazard, kLeftHazard, kLeftHazard})};
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
  DriveSetup setup{.hazards = Sequence({kLeftHazard, kLeftHazard})};
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
  DriveSetup setup{.hazards = Always(kLeftHazard)};
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.turns(); }));
  drive.UpdatePose({setup.goal.x_m, setup.goal.y_m + 0.05, 0.3});
  EXPECT_EQ(drive.Step().decision.status, NavigatorStatus::kArrived);
}

// Extras known from the flight rover, all off by default: time-out, back-off and threading.

// Measured distance of the backward drive, summed over the log.
double BackedOff(const std::vector<Tick>& log) {
  double backed_m = 0.0;
  for (std::size_t i = 0; i + 1 < log.size(); ++i) {
    if (log[i].backs()) backed_m += MotionBetween(log, i, i + 1).driven_m;
  }
  return backed_m;
}

bool DrivesForward(const Tick& tick) { return tick.drives() && tick.decision.motion.direction > 0; }

void ExpectTimeOut(DriveSetup setup) {
  setup.params.time_out_s = 5.0;
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  ExpectEnds(drive.log().back().time_s, 5.0, setup.rover.tick_s);
}

TEST(TimeOut, EndsEveryManoeuvre) {
  DriveSetup setup;
  ExpectTimeOut(setup);
  setup.hazards = Always(kLeftHazard);
  setup.params.turn_increment_rad = math::DegToRad(90.0);
  ExpectTimeOut(setup);
  setup.rover.turn_rate_rad_s = 0.01;
  ExpectTimeOut(setup);
  setup.sensor = HazardSensor::kOff;
  ExpectTimeOut(setup);
  setup.rover.speed_m_s = 0.0;
  ExpectTimeOut(setup);
}

TEST(TimeOut, DoesNotEndADriveThatArrivesEarlier) {
  DriveSetup setup;
  setup.params.time_out_s = 200.0;
  Drive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

TEST(BackOff, ComesBeforeTurningAwayFromHazardsOnBothSides) {
  DriveSetup setup;
  setup.params.back_off_m = 0.1;
  setup.hazards = Sequence({kClear, kClear, kAllHazards});
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.has_report && t.report != kClear; }));
  EXPECT_TRUE(drive.log().back().drives());
  EXPECT_EQ(drive.log().back().decision.motion.direction, -1);
  EXPECT_EQ(drive.log().back().decision.motion.curvature_per_m, 0.0);
  const double start_m = drive.log().back().estimate.distance_m;
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.moves() && !t.backs(); }));
  EXPECT_TRUE(drive.log().back().turns());
  const double backed_m = drive.log().back().estimate.distance_m - start_m;
  ExpectEnds(backed_m, 0.1, setup.rover.tick_distance_m());
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

TEST(BackOff, IsDrivenOncePerTurnAway) {
  DriveSetup setup;
  setup.params.back_off_m = 0.1;
  setup.hazards = Always(kAllHazards);
  Drive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  ExpectEnds(BackedOff(drive.log()), 0.1, setup.rover.tick_distance_m());
}

TEST(BackOff, IsNoAnswerToHazardsOnOneSide) {
  for (const Stripes& stripes : {kLeftHazard, kRightHazard, kCentreHazard}) {
    DriveSetup setup;
    setup.params.back_off_m = 0.1;
    setup.hazards = Sequence({kClear, stripes, stripes});
    Drive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_EQ(BackedOff(drive.log()), 0.0);
  }
}

TEST(BackOff, IsOffByDefault) {
  DriveSetup setup{.hazards = Sequence({kClear, kAllHazards, kAllHazards})};
  Drive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(BackedOff(drive.log()), 0.0);
}

DriveSetup ThreadingSetup(const Stripes& stripes) {
  DriveSetup setup;
  setup.params.threading_m = 0.2;
  setup.start = {0.0, 0.0, 0.3};  // off the goal's bearing: going straight shows
  setup.hazards = [stripes](const FakeRover& rover, int) {
    return rover.estimate().distance_m < 0.15 ? stripes : kClear;
  };
  return setup;
}

TEST(Threading, DrivesStraightBetweenOutermostHazards) {
  const DriveSetup setup = ThreadingSetup(kOutermostHazards);
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.moves(); }));
  EXPECT_TRUE(DrivesForward(drive.log().back()));
  EXPECT_EQ(drive.log().back().decision.motion.curvature_per_m, 0.0);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  for (const Tick& tick : drive.log()) {
    EXPECT_FALSE(tick.turns());
    if (tick.estimate.distance_m < 0.15 && tick.drives()) {
      EXPECT_EQ(tick.decision.motion.curvature_per_m, 0.0);
    }
  }
}

TEST(Threading, LooksAgainAfterItsDistanceAtTheLatest) {
  const DriveSetup setup = ThreadingSetup(kOutermostHazards);
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const std::vector<std::size_t> scans = ScanTicks(drive.log());
  for (std::size_t i = 1; i < scans.size(); ++i) {
    EXPECT_LE(MotionBetween(drive.log(), scans[i - 1], scans[i]).driven_m,
              setup.params.threading_m + setup.rover.tick_distance_m() + kRounding);
  }
}

TEST(Threading, SteersTowardsTheGoalOnlyAfterAClearReport) {
  for (const double heading_deg : {20.0, 120.0}) {
    SCOPED_TRACE(heading_deg);
    DriveSetup setup;
    setup.params.threading_m = 0.03;  // shorter than the distance between scans
    setup.start = {0.0, 0.0, math::DegToRad(heading_deg)};
    setup.hazards = Sequence({kOutermostHazards, kOutermostHazards});
    Drive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.has_report && t.report == kClear; }));
    int steering_ticks = 0;
    for (const Tick& tick : drive.log()) {
      if (tick.has_report && tick.report == kClear) break;
      if (tick.turns() || tick.decision.motion.curvature_per_m != 0.0) ++steering_ticks;
    }
    EXPECT_EQ(steering_ticks, 0);
  }
}

TEST(Threading, StopsAtTheGoal) {
  DriveSetup setup;
  setup.params.threading_m = 2.0;
  setup.goal = {1.0, 0.0};
  setup.hazards = Always(kOutermostHazards);
  Drive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_LE(drive.rover().estimate().distance_m, 1.0);
}

TEST(Threading, IsNoAnswerToAnyOtherPattern) {
  for (unsigned pattern = 1; pattern < 32; ++pattern) {
    Stripes stripes{};
    for (std::size_t i = 0; i < stripes.size(); ++i) stripes[i] = ((pattern >> i) & 1u) != 0;
    if (stripes == kOutermostHazards) continue;
    Drive drive(ThreadingSetup(stripes));
    ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.moves(); }));
    EXPECT_TRUE(drive.log().back().turns()) << pattern;
  }
}

TEST(Threading, IsOffByDefault) {
  DriveSetup setup = ThreadingSetup(kOutermostHazards);
  setup.params.threading_m = 0.0;
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.moves(); }));
  EXPECT_TRUE(drive.log().back().turns());
}

}  // namespace
}  // namespace rockyard::navigation
