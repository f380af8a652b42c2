// Counts of stops, turns on the spot, moves and turns of the steering motors; the slope of squared
// errors along a run, and hazards believed and begun: closed forms, scripts and traced drives.

#include "trial/counters/drive_counters.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <map>
#include <set>

#include "core/check.h"
#include "math/angles.h"
#include "trial/counters/drive_monitor.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using messages::MotionCommand;
using messages::MotionKind;

std::int64_t StopsOf(std::initializer_list<bool> moving) {
  StopCounter counter;
  for (const bool each : moving) counter.Observe(each);
  return counter.stops();
}

TEST(StopCounterTest, CountsEndsOfMotion) {
  EXPECT_EQ(StopsOf({}), 0);
  EXPECT_EQ(StopsOf({false, false}), 0);
  EXPECT_EQ(StopsOf({true, true, false, false, true, false}), 2);
}

TEST(StopCounterTest, TheEndStopsARoverThatMoves) { EXPECT_EQ(StopsOf({true, false, true}), 2); }

constexpr MotionCommand kLeft{MotionKind::kTurnInPlace, 0.0, 1};
constexpr MotionCommand kRight{MotionKind::kTurnInPlace, 0.0, -1};
constexpr MotionCommand kAhead{MotionKind::kArc, 0.0, 1};
constexpr MotionCommand kBack{MotionKind::kArc, 0.0, -1};

std::int64_t Turns(std::initializer_list<MotionCommand> motions) {
  TurnCounter counter;
  for (const MotionCommand& motion : motions) counter.Observe(motion);
  return counter.turns();
}

TEST(TurnCounterTest, ATurnCountsOnceHoweverLong) {
  EXPECT_EQ(Turns({}), 0);
  EXPECT_EQ(Turns({kAhead, kBack, kAhead}), 0);
  EXPECT_EQ(Turns({kLeft, kLeft, kLeft}), 1);
}

TEST(TurnCounterTest, DrivingEndsATurn) {
  EXPECT_EQ(Turns({kLeft, kAhead, kLeft, kLeft, kBack, kRight}), 3);
}

TEST(TurnCounterTest, TheOtherWayIsAnotherTurn) {
  EXPECT_EQ(Turns({kLeft, kLeft, kRight, kRight, kLeft}), 3);
}

constexpr MotionCommand kArc{MotionKind::kArc, 0.5, 1};

TEST(MoveCounterTest, AMoveIsOneCommandUntilAnotherOneOrALook) {
  constexpr MotionCommand kBackAlongIt{MotionKind::kArc, 0.5, -1};
  MoveCounter counter;
  EXPECT_EQ(counter.moves(), 0);
  counter.Observe(kArc);
  counter.Observe(kArc);
  EXPECT_EQ(counter.moves(), 1);
  counter.OnLook();
  counter.Observe(kArc);  // the same arc again
  EXPECT_EQ(counter.moves(), 2);
  counter.Observe(kBackAlongIt);  // backs off without a look
  EXPECT_EQ(counter.moves(), 3);
  counter.Observe(MotionCommand{});  // stands: no move
  EXPECT_EQ(counter.moves(), 3);
  counter.Observe(kLeft);
  counter.Observe(kLeft);
  EXPECT_EQ(counter.moves(), 4);
  EXPECT_EQ(counter.point_turns(), 1);
}

TEST(MoveCounterTest, AMoveWithANumberIsWhateverHasTheNumber) {
  MoveCounter counter;
  MotionCommand command{.kind = MotionKind::kArc, .move = 3};
  for (int tick = 0; tick < 200; ++tick) {
    command.curvature_per_m = 0.001 * tick;
    EXPECT_EQ(counter.Observe(command), tick == 0);
  }
  counter.OnLook();
  EXPECT_FALSE(counter.Observe(command));
  EXPECT_EQ(counter.moves(), 1);
  command.move = 4;
  EXPECT_TRUE(counter.Observe(command));
  // Without one, each command that differs is a move, in its end and speed too.
  command.move = 0;
  EXPECT_TRUE(counter.Observe(command));
  command.speed_share = 0.5;
  EXPECT_TRUE(counter.Observe(command));
  command.end_m = 1.0;
  EXPECT_TRUE(counter.Observe(command));
  EXPECT_FALSE(counter.Observe(command));
  EXPECT_EQ(counter.moves(), 5);
}

TEST(MoveCounterTest, SaysWhereAMoveBegins) {
  MoveCounter counter;
  EXPECT_TRUE(counter.Observe(kArc));
  EXPECT_FALSE(counter.Observe(kArc));
  counter.OnLook();
  EXPECT_TRUE(counter.Observe(kArc));
  EXPECT_FALSE(counter.Observe(MotionCommand{}));
}

TEST(MoveCounterTest, ReversalsAreArcsTheOtherWayThanTheLastOne) {
  constexpr MotionCommand kOtherBack{MotionKind::kArc, -0.2, -1};
  MoveCounter counter;
  counter.Observe(kOtherBack);  // the first has nothing before it
  counter.OnLook();
  counter.Observe(kOtherBack);
  EXPECT_EQ(counter.reversals(), 0);
  counter.Observe(kArc);
  EXPECT_EQ(counter.reversals(), 1);
  counter.Observe(kRight);  // to the right: no way of driving
  EXPECT_EQ(counter.reversals(), 1);
  counter.OnLook();
  counter.Observe(kArc);
  EXPECT_EQ(counter.reversals(), 1);
  counter.Observe(kRight);
  counter.Observe(kOtherBack);
  EXPECT_EQ(counter.reversals(), 2);
}

constexpr messages::PerWheel<bool> kCorners = {true, false, true, true, false, true};
constexpr messages::PerWheel<bool> kAll = {true, true, true, true, true, true};

TEST(SteerCounterTest, ToAndFroAddUp) {
  SteerCounter counter(kCorners);
  counter.Observe({0.2, 0.0, -0.2, 0.1, 0.0, -0.1});
  counter.Observe({0.2, 0.0, -0.2, 0.1, 0.0, -0.1});
  counter.Observe({-0.1, 0.0, 0.1, 0.0, 0.0, 0.0});
  // 0.2 + 0.3 twice, 0.1 + 0.1 twice.
  EXPECT_NEAR(counter.mean_rad(), (0.5 + 0.5 + 0.2 + 0.2) / 4.0, 1e-15);
  EXPECT_NEAR(counter.max_rad(), 0.5, 1e-15);
}

TEST(SteerCounterTest, EitherSideAndWayCountAlike) {
  SteerCounter left(kCorners);
  SteerCounter right(kCorners);
  left.Observe({0.3, 0.0, -0.2, 0.2, 0.0, -0.1});
  right.Observe({-0.2, 0.0, 0.1, -0.3, 0.0, 0.2});
  EXPECT_NEAR(left.mean_rad(), right.mean_rad(), 1e-15);
  EXPECT_EQ(left.max_rad(), right.max_rad());
}

// The mean is over the motors that there are.
TEST(SteerCounterTest, WheelsThatAreNotSteeredHaveNoMotor) {
  const messages::PerWheel<double> angles = {0.1, 0.9, 0.1, 0.1, 0.0, 0.1};
  SteerCounter corners(kCorners);
  corners.Observe(angles);
  EXPECT_NEAR(corners.mean_rad(), 0.1, 1e-15);
  EXPECT_NEAR(corners.max_rad(), 0.1, 1e-15);
  SteerCounter all(kAll);
  all.Observe(angles);
  EXPECT_NEAR(all.mean_rad(), 1.3 / 6.0, 1e-15);
  EXPECT_NEAR(all.max_rad(), 0.9, 1e-15);
  EXPECT_THROW(SteerCounter(messages::PerWheel<bool>{}), core::ContractViolation);
}

TEST(SteerCounterTest, WhatIsTurnedByHandDoesNotCount) {
  SteerCounter counter(kCorners);
  counter.Observe({0.4, 0.0, 0.4, 0.4, 0.0, 0.4});
  counter.Restart({});
  counter.Observe({0.1, 0.0, 0.1, 0.1, 0.0, 0.1});
  EXPECT_NEAR(counter.mean_rad(), 0.5, 1e-15);
}

TEST(ErrorGrowthTest, IsZeroWithoutAWay) {
  ErrorGrowth growth;
  EXPECT_EQ(growth.per_m(), 0.0);
  growth.Observe(0.0, 3.0);
  EXPECT_EQ(growth.per_m(), 0.0);
}

// e^2 = q x lies on a line through the origin, whatever the steps.
TEST(ErrorGrowthTest, IsTheSlopeOfALine) {
  ErrorGrowth growth;
  double x_m = 0.0;
  for (int i = 1; i <= 300; ++i) {
    x_m += 0.01 * (1 + i % 3);
    growth.Observe(x_m, (i % 2 == 0 ? 1.0 : -1.0) * std::sqrt(0.7 * x_m));
  }
  EXPECT_NEAR(growth.per_m(), 0.7, 1e-12);
}

// e = a x: the integral of x a^2 x^2 over that of x^2 is a^2 3 X / 4.
TEST(ErrorGrowthTest, OfAScaleErrorIsThreeQuartersOfTheEnd) {
  ErrorGrowth growth;
  for (int i = 1; i <= 70000; ++i) growth.Observe(1e-4 * i, 0.06 * 1e-4 * i);
  EXPECT_NEAR(growth.per_m(), 0.06 * 0.06 * 0.75 * 7.0, 1e-5 * 0.0189);
}

TEST(ErrorGrowthTest, ARoverThatStandsAddsNothing) {
  ErrorGrowth growth;
  growth.Observe(1.0, 2.0);
  for (int i = 0; i < 100; ++i) growth.Observe(1.0, 50.0);
  EXPECT_EQ(growth.per_m(), 4.0);
}

struct Slopes {
  double heading_deg2_per_m = 0.0;
  double distance_m2_per_m = 0.0;
};

// Least squares over the chords of a traced path; where operators set the rover back one begins.
Slopes SlopesOf(const truth::Trace& trace) {
  double way_m = 0.0;
  double heading = 0.0;
  double distance = 0.0;
  double weight = 0.0;
  double counted_m = 0.0;
  math::Pose2 start = trace.rests.front().sample.pose;
  math::Pose2 last = start;
  std::size_t rest = 0;
  const auto chord_m = [&] { return std::hypot(last.x_m - start.x_m, last.y_m - start.y_m); };
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    for (; rest < trace.rests.size() && trace.rests[rest].samples_before <= i; ++rest) {
      if (!trace.rests[rest].set_back) continue;
      way_m += chord_m();
      start = trace.rests[rest].sample.pose;
    }
    const truth::TraceSample& sample = trace.samples[i];
    last = sample.pose;
    if (chord_m() < DriveMonitor::kChord_m) continue;
    way_m += chord_m();
    start = last;
    const double dx_m = way_m - counted_m;
    counted_m = way_m;
    const double heading_deg =
        math::RadToDeg(math::WrapAngle(sample.pose.heading_rad - sample.estimate.heading_rad));
    const double distance_m = way_m - sample.estimate.distance_m;
    heading += way_m * heading_deg * heading_deg * dx_m;
    distance += way_m * distance_m * distance_m * dx_m;
    weight += way_m * way_m * dx_m;
  }
  return {heading / weight, distance / weight};
}

// `share`: how near the columns come.
void ExpectColumnsOf(const TracedTrial& trial, double share) {
  const Slopes slopes = SlopesOf(trial.trace);
  const truth::DriveRecord& record = trial.result.record;
  EXPECT_GT(slopes.heading_deg2_per_m, 0.0);
  EXPECT_NEAR(record.heading_growth_deg2_per_m / slopes.heading_deg2_per_m, 1.0, share);
  EXPECT_NEAR(record.distance_growth_m2_per_m / slopes.distance_m2_per_m, 1.0, share);
}

TEST(ErrorGrowthColumnsTest, AreTheSlopesOfTheTracedErrors) {
  for (const std::uint32_t index : {0u, 1u, 2u}) {
    ExpectColumnsOf(RunTraced(Pathfinder("level_sand", {"rover.fidelity=quasi_static"}), index),
                    1e-9);
  }
}

// Errors go on over a reflection: it turns truth and belief alike. The chord that it closes takes
// the error of the tick after it.
TEST(ErrorGrowthColumnsTest, GoOnOverReflections) {
  const TracedTrial trial =
      RunTraced(Pathfinder("level_sand",
                           {"rover.fidelity=quasi_static", "terrain.arena.kind=virtual_reflected",
                            "course.start_heading_deg=20", "course.start_y_m=0.9",
                            "navigation.pathfinder.heading_deadband_deg=30"}),
                0);
  ASSERT_GT(trial.result.record.reflections, 0.0);
  ExpectColumnsOf(trial, 1e-5);
}

HazardCounter CountOf(std::initializer_list<bool> reports) {
  HazardCounter counter;
  for (const bool believed : reports) counter.Observe(believed);
  return counter;
}

TEST(HazardCounterTest, AHazardBeginsOnceForEachRunOfReports) {
  EXPECT_EQ(CountOf({}).begun(), 0);
  EXPECT_EQ(CountOf({false, false}).begun(), 0);
  EXPECT_EQ(CountOf({true}).begun(), 1);
  EXPECT_EQ(CountOf({false, true, true, true, false}).begun(), 1);
  EXPECT_EQ(CountOf({true, true, false, true, false, false, true}).begun(), 3);
}

TEST(HazardCounterTest, EveryReportIsBelieved) {
  EXPECT_EQ(CountOf({}).believed(), 0);
  EXPECT_EQ(CountOf({true, true, false, true, false, false, true}).believed(), 4);
}

// A drive over level sand at high rocks on the straight line to the goal.
TracedTrial DriveAtRocks(std::uint32_t index) {
  return RunTraced(
      Pathfinder("level_sand",
                 {"rover.fidelity=quasi_static", "perception.hazard.enabled=true",
                  "terrain.rocks.kind=listed", "terrain.rocks.listed.x_m=[2.5, 5.5]",
                  "terrain.rocks.listed.y_m=[0, 0]", "terrain.rocks.listed.diameter_m=[0.3, 0.3]",
                  "terrain.rocks.listed.height_m=[0.3, 0.3]"}),
      index);
}

// Whether each look of a trace believed in a hazard. A look ends with the last of its scans.
std::vector<bool> LooksOf(const truth::Trace& trace) {
  std::set<double> hazard_times_s;
  for (const truth::TraceEvent& event : EventsOf(trace, "hazard")) {
    hazard_times_s.insert(event.time_s);
  }
  std::map<std::size_t, double> looks_s;  // end of each look, by the ticks before it
  for (const truth::TraceRest& rest : trace.rests) {
    if (rest.sample.activity == "scan") looks_s[rest.samples_before] = rest.sample.time_s;
  }
  std::vector<bool> believed;
  for (const auto& [samples, time_s] : looks_s) believed.push_back(hazard_times_s.contains(time_s));
  return believed;
}

TEST(HazardsBegunTest, AreReportsAfterALookWithout) {
  for (const std::uint32_t index : {0u, 1u, 2u}) {
    const TracedTrial trial = DriveAtRocks(index);
    double believed = 0.0;
    double begun = 0.0;
    bool before = false;
    for (const bool now : LooksOf(trial.trace)) {
      if (now) ++believed;
      if (now && !before) ++begun;
      before = now;
    }
    EXPECT_GE(begun, 2.0);
    EXPECT_GT(believed, begun);
    EXPECT_EQ(trial.result.record.hazards_believed, believed);
    EXPECT_EQ(trial.result.record.hazards_begun, begun);
  }
}

}  // namespace
}  // namespace rockyard::trial
