// Extras known from the flight rover, all off by default: time-out, back-off and threading.
#include <gtest/gtest.h>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

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
  DriveSetup setup;
  setup.hazards = Sequence({kClear, kAllHazards, kAllHazards});
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
