// GESTALT on the move: where it looks, waits and stops, and what it drives meanwhile.

#include <cmath>
#include <limits>
#include <set>

#include "drive.h"

namespace rockyard::navigation {
namespace {

class DriveOnTheMove : public OnTheMove {};

INSTANTIATE_TEST_SUITE_P(Cycles, DriveOnTheMove, testing::ValuesIn(kOnTheMove));

TEST_P(DriveOnTheMove, StandsOnceToLookOnEmptyGroundAndDrivesOn) {
  for (const int latency_ticks : {0, 10, 60}) {
    GestaltSetup setup = setup_;
    setup.latency_ticks = latency_ticks;
    GestaltDrive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_EQ(drive.StopsToLook(), 1) << "at the start";
    const auto& log = drive.log();
    EXPECT_TRUE(std::none_of(log.begin() + 1, log.end() - 1,
                             [](const GestaltTick& tick) { return tick.stands(); }));
    const PlanCounts counts = drive.navigator().plan_counts();
    EXPECT_EQ(counts.plans, drive.Answers() - 1);
    EXPECT_EQ(counts.started, counts.plans);
    // Each plan is a move of its own, whatever its curvatures.
    std::set<std::int64_t> moves;
    for (std::size_t i = 1; i + 1 < log.size(); ++i) moves.insert(log[i].motion.move);
    EXPECT_EQ(static_cast<std::int64_t>(moves.size()), counts.plans + 1);
    EXPECT_EQ(moves.count(0), 0u);
    EXPECT_EQ(counts.late, 0);
    EXPECT_EQ(counts.unsafe, 0);
    // One each half metre and what the rover drives until it is ready.
    const double cycle_m = 0.5 + (latency_ticks + 1) * setup.rover.tick_distance_m();
    EXPECT_NEAR(static_cast<double>(counts.plans), 7.5 / cycle_m, 1.0) << latency_ticks;
  }
}

// The control: the same rover that stops to look does so at each step.
TEST(ContinuousDrive, StopAndLookNeverLooksOnTheMove) {
  GestaltDrive drive(SetupOf(DriveCycle::kStopAndLook));
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_NEAR(drive.StopsToLook(), 7.5 / 0.35, 1.0);
  EXPECT_EQ(drive.navigator().plan_counts().plans, 0);
}

// A new plan each half metre finds round it by a longer way than one each 35 cm.
TEST(ContinuousDrive, GoesRoundABlock) {
  for (const double y_m : {-0.2, 0.15, 0.4}) {
    const auto driven_m = [&](DriveCycle cycle) {
      GestaltSetup setup = SetupOf(cycle);
      const Block block{4.0, 4.6, y_m - 0.5, y_m + 0.5};
      setup.height = Blocks({block});
      setup.latency_ticks = 8;
      GestaltDrive drive(setup);
      EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
      ExpectClearOf(drive, block);
      EXPECT_LT(drive.rover().estimate().distance_m, 11.0);
      return drive.rover().estimate().distance_m;
    };
    const double stopping_m = driven_m(DriveCycle::kStopAndLook);
    for (const DriveCycle cycle : kOnTheMove) EXPECT_LT(driven_m(cycle), 1.3 * stopping_m);
  }
}

// Of a spline the curvature changes by its rate times the way of a tick at most, over replans too,
// where it is predicted without error.
void ExpectContinuousCurvature(PlanStart start, int latency_ticks) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.params.continuous.plan_start = start;
  setup.height = Blocks({{3.0, 3.4, -0.3, 0.7}, {5.6, 6.2, -0.9, 0.1}});
  setup.latency_ticks = latency_ticks;
  GestaltDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  ASSERT_EQ(drive.StopsToLook(), 1);
  const GestaltSplineParams& splines = setup.params.splines;
  const double most =
      2.0 * splines.max_curvature_per_m / (0.5 * splines.length_m) * setup.rover.tick_distance_m();
  double largest = 0.0;
  double bent = 0.0;
  const auto& log = drive.log();
  for (std::size_t i = 2; i + 1 < log.size(); ++i) {
    largest = std::max(largest,
                       std::abs(log[i].motion.curvature_per_m - log[i - 1].motion.curvature_per_m));
    bent = std::max(bent, std::abs(log[i].motion.curvature_per_m));
  }
  EXPECT_LE(largest, most * (1.0 + 1e-6));
  EXPECT_GT(bent, 0.2) << "it has to steer";
  EXPECT_NEAR(drive.navigator().plan_counts().start_error_squared_m2, 0.0, kRounding);
}

TEST(ContinuousDrive, CurvatureOfSplinesIsContinuousOverReplans) {
  for (const PlanStart start : {PlanStart::kPredicted, PlanStart::kEstimated}) {
    for (const int latency_ticks : {0, 25}) ExpectContinuousCurvature(start, latency_ticks);
  }
}

// With arcs the curvature jumps: the negative control of the test above.
TEST(ContinuousDrive, CurvatureOfArcsJumps) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsod);
  setup.height = Blocks({{3.0, 3.4, -0.3, 0.7}});
  GestaltDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  double largest = 0.0;
  for (std::size_t i = 2; i + 1 < drive.log().size(); ++i) {
    largest = std::max(largest, std::abs(drive.log()[i].motion.curvature_per_m -
                                         drive.log()[i - 1].motion.curvature_per_m));
  }
  EXPECT_GT(largest, 0.15);
}

TEST_P(DriveOnTheMove, WaitsAtTheEndOfItsMotionForALatePlan) {
  for (const LatePlan late : {LatePlan::kWait, LatePlan::kStopAndLook}) {
    GestaltSetup setup = setup_;
    setup.params.continuous.late_plan = late;
    // Half a metre takes 143 ticks.
    setup.latency_ticks = 400;
    GestaltDrive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    const PlanCounts counts = drive.navigator().plan_counts();
    EXPECT_NEAR(static_cast<double>(counts.late), 7.5, 1.0);
    if (late == LatePlan::kWait) {
      EXPECT_EQ(drive.StopsToLook(), 1);
      EXPECT_EQ(counts.started, counts.plans);
    } else {
      EXPECT_EQ(drive.StopsToLook(), 1 + counts.late);
      EXPECT_EQ(counts.plans, 0);
    }
    // It never drives beyond the motion that was judged.
    double begun_m = 0.0;
    for (const GestaltTick& tick : drive.log()) {
      if (tick.has_cloud) begun_m = tick.estimate.distance_m;
      ASSERT_LE(tick.estimate.distance_m - begun_m,
                setup.params.continuous.motion_m + setup.rover.tick_distance_m() + kRounding);
    }
  }
}

// An answer that never comes ends in a look at rest, not in a wait for ever.
TEST_P(DriveOnTheMove, ALostAnswerIsWaitedForUpToTheTimeOut) {
  setup_.goal = {2.4, 0.0};
  setup_.loses_answers = true;
  setup_.params.drive.step_time_out_s = 40.0;
  GestaltDrive drive(setup_);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(drive.StopsToLook(), 2);
  EXPECT_NEAR(drive.log().back().time_s, 40.0 + 0.9 / 0.07, 1.0);
}

// Operators who move the rover while it awaits a look make it ask again, at once: what it saw from
// elsewhere is told no more.
TEST_P(DriveOnTheMove, OperatorsWhoMoveItMakeItLookAgain) {
  setup_.latency_ticks = 40;
  GestaltDrive drive(setup_);
  while (drive.log().empty() || !drive.log().back().decision.looks_on_the_move) drive.Step();
  drive.Step();
  ASSERT_FALSE(drive.log().back().decision.looks()) << "it waits for the answer";
  drive.MoveByHand({drive.rover().estimate().x_m, 0.2, 0.0});
  drive.Step();
  EXPECT_TRUE(drive.log().back().decision.looks_on_the_move);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(drive.navigator().plan_counts().late, 0);
}

// A blind alley, too narrow to turn round in: no plan is safe. It stops at once, or at the end of
// what was judged.
TEST_P(DriveOnTheMove, StopsOrFinishesWhereNoPlanIsSafe) {
  const auto stops_at = [&](NoSafePlan choice) {
    GestaltSetup setup = setup_;
    // Seen late: the rover is 1.2 m from it when its looks reach it.
    SeeNearGroundOnly(setup);
    setup.params.drive.search_turn_rad = math::DegToRad(90.0);
    const Block end{3.0, 3.4, -1.0, 1.0};
    setup.height = Blocks({end, {-1.0, 3.4, 1.0, 1.4}, {-1.0, 3.4, -1.4, -1.0}});
    setup.params.continuous.no_safe_plan = choice;
    GestaltDrive drive(setup);
    drive.Run();
    EXPECT_GE(drive.navigator().plan_counts().unsafe, 1);
    ExpectClearOf(drive, end);
    const auto& log = drive.log();
    // Where it first stops to look after it has begun.
    const auto stop = std::find_if(log.begin() + 2, log.end(), [](const GestaltTick& tick) {
      return tick.decision.stops_to_look();
    });
    return stop == log.end() ? std::numeric_limits<double>::infinity() : stop->estimate.distance_m;
  };
  EXPECT_LT(stops_at(NoSafePlan::kStop) + 0.3, stops_at(NoSafePlan::kFinish));
}

TEST_P(DriveOnTheMove, BacksOffFromAHazardThatItFeelsAndLooksAtRest) {
  setup_.latency_ticks = 40;
  // While a look is under way: it is asked for at 0.5 m, which takes 143 ticks.
  setup_.feels = [](int tick) { return tick == 160; };
  GestaltDrive drive(setup_);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const auto& log = drive.log();
  EXPECT_LT(log[161].motion.direction, 0);
  // The answer that comes while it backs off leads to nothing.
  const auto stop = std::find_if(log.begin() + 162, log.end(), [](const GestaltTick& tick) {
    return tick.decision.stops_to_look();
  });
  ASSERT_NE(stop, log.end());
  EXPECT_TRUE(std::all_of(log.begin() + 161, stop,
                          [](const GestaltTick& tick) { return tick.motion.direction < 0; }));
}

// What is seen on the move lies where it was seen from, however late it is told.
TEST_P(DriveOnTheMove, PointsLieWhereTheyWereSeenFrom) {
  const auto map_of = [&](int latency_ticks) {
    GestaltSetup setup = setup_;
    setup.height = Blocks({{3.0, 3.4, 1.4, 1.8}, {3.0, 3.4, -1.8, -1.4}});
    setup.latency_ticks = latency_ticks;
    GestaltDrive drive(setup);
    while (drive.navigator().plan_counts().plans < 2) drive.Step();
    return drive.navigator().view()->map;
  };
  const messages::MapView soon = map_of(0);
  const messages::MapView late = map_of(120);
  // Cells hold the mean heights of what lies in them: blocks of half a metre on the ground.
  for (const messages::MapView* map : {&soon, &late}) {
    int high = 0;
    for (int iy = 0; iy < map->ny; ++iy) {
      for (int ix = 0; ix < map->nx; ++ix) {
        const messages::MapCellView& cell = map->Cell(ix, iy);
        if (!cell.has_data || cell.elevation_m < 0.25) continue;
        ++high;
        const double x_m = map->x0_m + (ix + 0.5) * map->xstep_m;
        const double y_m = map->y0_m + (iy + 0.5) * map->ystep_m;
        EXPECT_TRUE(x_m > 3.0 && x_m < 3.4 && std::abs(y_m) > 1.4 && std::abs(y_m) < 1.8)
            << x_m << ", " << y_m;
      }
    }
    EXPECT_GE(high, 4);
  }
}

// Corrections while a look is under way move the goal around the rover, and nothing else: with a
// goal that jumps along the rover is told the same.
TEST_P(DriveOnTheMove, CorrectionsOnTheMoveMoveTheGoalAlone) {
  setup_.height = Blocks({{3.0, 3.6, -0.2, 0.8}});
  setup_.latency_ticks = 60;
  GestaltDrive plain(setup_);
  GestaltDrive corrected(setup_);
  messages::Goal goal = setup_.goal;
  const int ticks = 1000;
  for (int i = 0; i < ticks; ++i) {
    plain.Step();
    corrected.Step();
    if (i != 170 && i != 400) continue;
    // Both by (0.3, -0.2) m and 0.1 rad about the origin: p' = t + R p.
    const messages::PoseEstimate before = corrected.rover().estimate();
    const double c = std::cos(0.1);
    const double s = std::sin(0.1);
    const auto moved = [&](double x_m, double y_m) {
      return messages::Goal{0.3 + c * x_m - s * y_m, -0.2 + s * x_m + c * y_m};
    };
    const messages::Goal place = moved(before.x_m, before.y_m);
    corrected.Correct({place.x_m, place.y_m, before.heading_rad + 0.1});
    goal = moved(goal.x_m, goal.y_m);
    corrected.SetGoal(goal, GoalChange::kMoved);
  }
  for (int i = 0; i < ticks; ++i) {
    const auto at = static_cast<std::size_t>(i);
    ASSERT_NEAR(plain.log()[at].motion.curvature_per_m, corrected.log()[at].motion.curvature_per_m,
                1e-6)
        << i;
  }
  EXPECT_GE(plain.navigator().plan_counts().plans, 3);
}

// On a curved way, corrected and moved by hand, so that odometry and the map's frame differ by a
// turn: where it looked is known by odometry, and a plan begins where it was predicted to.
TEST(ContinuousDrive, TurnedFramesMoveNoLook) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.goal = {4.0, 4.0};
  setup.latency_ticks = 100;
  GestaltDrive drive(setup);
  while (drive.log().empty() || !drive.log().back().decision.looks_on_the_move) drive.Step();
  const messages::PoseEstimate before = drive.rover().estimate();
  drive.Correct({before.x_m, before.y_m, before.heading_rad + 1.5});
  drive.MoveByHand({before.x_m, before.y_m, before.heading_rad});
  while (drive.navigator().plan_counts().started < 1) drive.Step();
  EXPECT_NEAR(drive.navigator().plan_counts().start_error_squared_m2, 0.0, kRounding);
}

// Progress counts on over corrections: over those that change nothing at each tick, and over one by
// which the goal comes to lie two metres farther off.
TEST(ContinuousDrive, CorrectionsTakeNoProgressAway) {
  for (const bool jumps : {false, true}) {
    GestaltSetup setup = SetupOf(DriveCycle::kStopAndLook);
    setup.params.drive.max_fruitless_cycles = 4;
    GestaltDrive drive(setup);
    do {
      drive.Step();
      const messages::PoseEstimate here = drive.rover().estimate();
      const bool jumps_now = jumps && drive.log().size() == 200;
      if (!jumps || jumps_now) {
        drive.Correct({here.x_m - (jumps_now ? 2.0 : 0.0), here.y_m, here.heading_rad});
      }
    } while (drive.log().back().decision.status == NavigatorStatus::kDriving);
    EXPECT_EQ(drive.log().back().decision.status, NavigatorStatus::kArrived) << jumps;
  }
}

// A rover that is held up begins its plan elsewhere than was predicted, which is counted; plans
// that begin as estimated begin where it believes to be.
TEST(ContinuousDrive, TheErrorOfAPredictedStartIsCounted) {
  for (const PlanStart start : {PlanStart::kPredicted, PlanStart::kEstimated}) {
    int held_from = std::numeric_limits<int>::max() - 10;
    GestaltSetup setup = SetupOf(DriveCycle::kCsad);
    setup.params.continuous.plan_start = start;
    setup.latency_ticks = 20;
    setup.held = [&held_from](int tick) { return tick >= held_from && tick < held_from + 10; };
    GestaltDrive drive(setup);
    while (drive.log().empty() || !drive.log().back().decision.looks_on_the_move) drive.Step();
    held_from = static_cast<int>(drive.log().size()) + 3;
    while (drive.navigator().plan_counts().started < 1) drive.Step();
    const double error_m = std::sqrt(drive.navigator().plan_counts().start_error_squared_m2);
    const double missed_m = 10 * setup.rover.tick_distance_m();
    EXPECT_NEAR(error_m, start == PlanStart::kPredicted ? missed_m : 0.0, kRounding);
  }
}

}  // namespace
}  // namespace rockyard::navigation
