// GESTALT on the move: when it asks for a plan, what that is made of, and what comes of it.

#include <cmath>

#include "drive.h"
#include "navigation/gestalt/curvature_law.h"

namespace rockyard::navigation {
namespace {

// Steps until it is done.
template <typename Done>
void StepUntil(GestaltDrive& drive, const Done& done) {
  for (int i = 0; i < 20000; ++i) {
    drive.Step();
    if (done()) return;
  }
  ADD_FAILURE() << "it never is";
}

// Steps until it has asked for a look on the move.
void DriveToALook(GestaltDrive& drive) {
  StepUntil(drive, [&drive] { return drive.log().back().decision.looks_on_the_move; });
}

// Steps until so many plans have been made on the move.
void DriveToPlan(GestaltDrive& drive, std::int64_t number) {
  StepUntil(drive, [&drive, number] { return drive.navigator().plan_counts().plans >= number; });
}

// Steps until it has decided once more, at rest or on the move.
void DriveToDecision(GestaltDrive& drive) {
  const auto decisions = [&drive] {
    const messages::NavigationView* view = drive.navigator().view();
    return view == nullptr ? -1 : view->step;
  };
  const auto before = decisions();
  StepUntil(drive, [&] { return decisions() != before; });
}

bool Turns(const GestaltTick& tick) { return tick.motion.kind == MotionKind::kTurnInPlace; }

bool AnyVetoed(const messages::NavigationView& view) {
  const auto vetoed = [](const messages::MotionVote& vote) { return vote.vetoed; };
  return std::any_of(view.forward.begin(), view.forward.end(), vetoed);
}

class PlansOnTheMove : public OnTheMove {};

INSTANTIATE_TEST_SUITE_P(Cycles, PlansOnTheMove, testing::ValuesIn(kOnTheMove));

// After half of what is driven of a plan: of a metre, and of the way to a goal that is nearer.
TEST_P(PlansOnTheMove, AreAskedForAfterAShareOfTheMotion) {
  for (const double goal_m : {0.6, 8.0}) {
    GestaltSetup setup = setup_;
    setup.goal = {goal_m, 0.0};
    setup.params.waypoints.goal_tolerance_m = 0.05;
    GestaltDrive drive(setup);
    DriveToALook(drive);
    EXPECT_NEAR(drive.rover().estimate().distance_m, 0.5 * std::min(goal_m, 1.0),
                2.0 * setup.rover.tick_distance_m());
  }
}

// A metre of 256 ticks.
TEST_P(PlansOnTheMove, MotionsEndWhereTheirLengthIsDriven) {
  setup_.rover.tick_s = setup_.rover.speed_m_s = 1.0 / 16.0;
  setup_.loses_answers = true;
  GestaltDrive drive(setup_);
  DriveToALook(drive);
  StepUntil(drive, [&drive] { return drive.log().back().stands(); });
  EXPECT_EQ(drive.rover().estimate().distance_m, 1.0);
}

// A rover that drops a late look asks for another one in its next motion.
TEST_P(PlansOnTheMove, AreAskedForAgainAfterALateOne) {
  setup_.params.continuous.late_plan = LatePlan::kStopAndLook;
  setup_.latency_ticks = 400;
  GestaltDrive drive(setup_);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const auto looks =
      std::count_if(drive.log().begin(), drive.log().end(),
                    [](const GestaltTick& tick) { return tick.decision.looks_on_the_move; });
  EXPECT_GT(looks, 5);
  EXPECT_LE(std::abs(looks - drive.navigator().plan_counts().late), 1) << "the last motion";
}

// A rover that felt something while a look was under way asks for another one in its next motion.
TEST_P(PlansOnTheMove, AreAskedForAgainAfterAHazardThatWasFelt) {
  setup_.latency_ticks = 40;
  setup_.feels = [](int tick) { return tick == 160; };
  GestaltDrive drive(setup_);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(drive.navigator().plan_counts().late, 0);
}

// Between steps the goal is asked for where a plan is made, before the motion ends.
TEST_P(PlansOnTheMove, AreNotMadeAtTheGoal) {
  setup_.params.drive.arrival_check = ArrivalCheck::kBetweenSteps;
  GestaltDrive drive(setup_);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_TRUE(drive.log().back().has_cloud);
}

// A goal within the tightest circle is driven round: plans that lead no nearer come to an end.
TEST(ContinuousPlans, WithoutProgressEndTheDrive) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.goal = {1.0, 1.7};
  setup.params.waypoints.goal_tolerance_m = 0.1;
  setup.params.drive.max_fruitless_cycles = 5;
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.Run(8000), NavigatorStatus::kGaveUp);
  EXPECT_TRUE(drive.log().back().has_cloud);
}

// A vote of just min_vote_goodness is safe: on open ground the straight way has all that there is.
TEST_P(PlansOnTheMove, OfTheLeastVoteAllowedAreSafe) {
  setup_.params.plan.plan_max_dist_m = 2.0;
  setup_.params.votes.min_vote_goodness = 255.0;
  GestaltDrive drive(setup_);
  DriveToPlan(drive, 4);
  EXPECT_EQ(drive.StopsToLook(), 1);
  EXPECT_EQ(drive.navigator().plan_counts().unsafe, 0);
}

// The view of a plan: where it begins, in a map around the rover of now, and what is driven of it.
TEST_P(PlansOnTheMove, AreShownAsTheyAreDriven) {
  setup_.height = Blocks({{3.0, 3.4, -0.3, 0.7}});
  setup_.latency_ticks = 120;
  // No vote is good enough not to look behind at the start.
  setup_.params.votes.min_fwd_threshold = 256.0;
  GestaltDrive drive(setup_);
  DriveToDecision(drive);
  EXPECT_EQ(drive.navigator().view()->looked_behind, GetParam() == DriveCycle::kCsod);
  for (std::int64_t plan = 1; plan <= 3; ++plan) {
    DriveToPlan(drive, plan);
    const messages::NavigationView& view = *drive.navigator().view();
    const GestaltTick& now = drive.log().back();
    EXPECT_FALSE(view.looked_behind);
    EXPECT_NEAR(view.estimate.x_m, now.estimate.x_m, 1e-4);
    EXPECT_NEAR(view.estimate.y_m, now.estimate.y_m, 1e-4);
    EXPECT_NEAR(view.estimate.distance_m, now.estimate.distance_m, kRounding);
    EXPECT_EQ(view.spline_start.x_m, view.estimate.x_m);
    EXPECT_EQ(view.spline_start.y_m, view.estimate.y_m);
    EXPECT_NEAR(view.map.x0_m + 0.5 * view.map.nx * view.map.xstep_m, now.estimate.x_m, 0.2);
    if (GetParam() == DriveCycle::kCsad) {
      std::vector<messages::SplineVote> chosen;
      std::copy_if(view.splines.begin(), view.splines.end(), std::back_inserter(chosen),
                   [](const messages::SplineVote& vote) { return vote.chosen; });
      ASSERT_EQ(chosen.size(), 1u);
      EXPECT_EQ(chosen.front().spline.start_per_m, now.decision.motion.curvature_per_m);
    } else {
      std::vector<messages::MotionVote> chosen;
      std::copy_if(view.forward.begin(), view.forward.end(), std::back_inserter(chosen),
                   [](const messages::MotionVote& vote) { return vote.chosen; });
      ASSERT_EQ(chosen.size(), 1u);
      EXPECT_EQ(chosen.front().motion.curvature_per_m, now.decision.motion.curvature_per_m);
    }
  }
}

// A motion is told with the speed of its curvature and, along a spline, with how that changes.
TEST_P(PlansOnTheMove, AreToldWithSpeedAndRateOfTheMoment) {
  setup_.height = Blocks({{3.0, 3.4, -0.3, 0.7}});
  setup_.params.speed = {
      .full_speed_curvature_per_m = 0.05, .min_speed_share = 0.5, .slow_curvature_per_m = 0.5};
  GestaltDrive drive(setup_);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  double slowest = 1.0;
  int bends = 0;
  const auto& log = drive.log();
  for (std::size_t i = 1; i + 2 < log.size(); ++i) {
    const messages::MotionCommand& motion = log[i].decision.motion;
    const messages::MotionCommand& next = log[i + 1].decision.motion;
    ASSERT_EQ(motion.speed_share, SpeedShare(setup_.params.speed, motion.curvature_per_m));
    slowest = std::min(slowest, motion.speed_share);
    const bool goes_on =
        motion.move == next.move && motion.curvature_rate_per_m2 == next.curvature_rate_per_m2;
    if (!goes_on) continue;
    const double way_m = log[i + 1].estimate.distance_m - log[i].estimate.distance_m;
    ASSERT_NEAR(next.curvature_per_m - motion.curvature_per_m, way_m * motion.curvature_rate_per_m2,
                kRounding);
    bends += next.curvature_per_m != motion.curvature_per_m ? 1 : 0;
  }
  EXPECT_LT(slowest, 0.9);
  EXPECT_EQ(bends > 100, GetParam() == DriveCycle::kCsad);
}

// A rover that has stopped to look drives on with the curvature for which its wheels stand.
TEST(ContinuousPlans, BeginAfterAStopWithTheCurvatureThatIsSteered) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.goal = {4.0, 4.0};
  setup.params.continuous.late_plan = LatePlan::kStopAndLook;
  setup.latency_ticks = 400;
  GestaltDrive drive(setup);
  ASSERT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const auto& log = drive.log();
  const double tick_m = setup.rover.tick_distance_m();
  int stops = 0;
  for (std::size_t i = 2; i + 1 < log.size(); ++i) {
    if (!log[i].decision.stops_to_look()) continue;
    const messages::MotionCommand& before = log[i - 1].decision.motion;
    EXPECT_NEAR(log[i + 1].decision.motion.curvature_per_m,
                before.curvature_per_m + before.curvature_rate_per_m2 * tick_m, 1e-6);
    stops += before.curvature_per_m != 0.0 ? 1 : 0;
  }
  EXPECT_GE(stops, 2);
}

// A look at the first tick of a motion knows the speed of that tick.
TEST(ContinuousPlans, AreStartedAsPredictedWhenAskedForAtOnce) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.params.continuous.replan_fraction = 0.002;
  setup.latency_ticks = 20;
  GestaltDrive drive(setup);
  DriveToPlan(drive, 6);
  EXPECT_NEAR(drive.navigator().plan_counts().start_error_squared_m2, 0.0, kRounding);
}

// A rover that rocks sees level ground where it knows how it stood when it looked.
TEST_P(PlansOnTheMove, TakePointsByTheAttitudeOfTheLook) {
  setup_.latency_ticks = 50;
  // At the start it stands still.
  setup_.attitude = [](int tick) {
    const double phase = 0.02 * std::max(0, tick - 10);
    return messages::AttitudeEstimate{.roll_rad = 0.05 * std::sin(1.5 * phase),
                                      .pitch_rad = 0.1 * std::sin(phase),
                                      .z_m = 0.05 * phase};
  };
  GestaltDrive drive(setup_);
  DriveToALook(drive);
  const auto looked = static_cast<int>(drive.log().size()) - 1;
  DriveToPlan(drive, 1);
  const messages::NavigationView& view = *drive.navigator().view();
  for (const messages::MapCellView& cell : view.map.cells) {
    if (!cell.has_data) continue;
    ASSERT_NEAR(cell.elevation_m, 0.0, kRounding);
  }
  EXPECT_EQ(view.attitude.pitch_rad, setup_.attitude(looked).pitch_rad);
}

// Howard 2012, section 2: "turn-in-place of different angles followed by a straight drive". The
// goal comes to lie abeam while the rover drives.
TEST(ContinuousPlans, OfCsodTurnInPlaceAndDriveStraightOn) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsod);
  setup.params.arcs.num_point_turns = 6;
  setup.params.drive.point_turns = PointTurns::kCandidates;
  setup.latency_ticks = 10;
  GestaltDrive drive(setup);
  DriveToPlan(drive, 1);
  drive.SetGoal({drive.rover().estimate().x_m + 0.5, 6.0}, GoalChange::kMoved);
  const auto turns = [&drive] { return Turns(drive.log().back()); };
  StepUntil(drive, turns);
  EXPECT_TRUE(drive.log().back().has_cloud);
  const std::vector<messages::MotionVote>& votes = drive.navigator().view()->point_turns;
  const auto turn = std::find_if(votes.begin(), votes.end(),
                                 [](const messages::MotionVote& vote) { return vote.chosen; });
  ASSERT_NE(turn, votes.end());
  EXPECT_GT(turn->turn_rad, 0.5);
  const double before_rad = drive.log().back().estimate.heading_rad;
  StepUntil(drive, [&] { return !turns(); });
  const GestaltTick& next = drive.log().back();
  EXPECT_NEAR(next.estimate.heading_rad - before_rad, turn->turn_rad, setup.rover.tick_turn_rad());
  EXPECT_EQ(next.motion.kind, MotionKind::kArc);
  EXPECT_EQ(next.motion.curvature_per_m, 0.0);
  EXPECT_EQ(next.motion.direction, +1);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(drive.StopsToLook(), 1);
}

// Between walls: where a turn leads is not safe, so that the rover looks after it.
TEST(ContinuousPlans, OfCsodLookAfterATurnTowardsAWall) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsod);
  setup.height = Blocks({{-2.0, 9.0, 1.2, 1.6}, {-2.0, 9.0, -1.6, -1.2}});
  // It drives up to walls that it has seen.
  setup.params.continuous.motion_m = 3.0;
  // It never turns at rest, and always on the move.
  setup.params.drive.search_turn_rad = 0.0;
  setup.params.drive.point_turns = PointTurns::kCandidates;
  setup.params.drive.point_turn_margin = -300.0;
  GestaltDrive drive(setup);
  const auto turns = [&drive] { return Turns(drive.log().back()); };
  StepUntil(drive, turns);
  StepUntil(drive, [&] { return !turns(); });
  EXPECT_TRUE(drive.log().back().decision.stops_to_look());
}

// With the goal behind it no spline leads there, but an arc does: along that it backs off.
TEST(ContinuousPlans, OfCsadLeaveNothingToAnArcAfterThem) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.params.waypoints.vote_index_variance = 1.0;
  bool feels = false;
  setup.feels = [&feels](int) { return feels; };
  GestaltDrive drive(setup);
  DriveToPlan(drive, 1);
  drive.SetGoal({drive.rover().estimate().x_m - 1.0, 0.7}, GoalChange::kMoved);
  const auto curvature = [&drive] { return drive.log().back().motion.curvature_per_m; };
  StepUntil(drive, [&] { return std::abs(curvature()) > 1.1; });
  const double arc_per_m = curvature();
  for (int i = 0; i < 20; ++i) drive.Step();
  ASSERT_EQ(curvature(), arc_per_m);
  feels = true;
  StepUntil(drive, [&drive] { return drive.log().back().motion.direction < 0; });
  EXPECT_EQ(curvature(), arc_per_m);
}

// Backward there is nothing ahead to plan for: the rover drives a step, and looks at rest.
TEST(ContinuousPlans, AreNotMadeOnTheWayBack) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsod);
  setup.goal = {-3.0, 0.0};
  setup.params.drive.backward_arcs = BackwardArcs::kAlways;
  setup.params.votes.min_fwd_threshold = 256.0;
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  int backward = 0;
  for (const GestaltTick& tick : drive.log()) {
    if (tick.motion.direction > 0) continue;
    ++backward;
    ASSERT_FALSE(tick.decision.looks_on_the_move);
  }
  EXPECT_GT(backward, 500);
}

// The arcs of CSOD face the goal where the next plan is made, half a metre on, and a step on where
// that is nearer.
TEST(ContinuousPlans, OfCsodFaceTheGoalWhereTheNextOneIsMade) {
  for (const double motion_m : {0.4, 1.0, 1.4}) {
    GestaltSetup setup = SetupOf(DriveCycle::kCsod);
    setup.params.continuous.motion_m = motion_m;
    setup.goal = {8.0 * std::cos(0.3), 8.0 * std::sin(0.3)};
    GestaltDrive drive(setup);
    drive.Step();
    drive.Step();
    const std::vector<messages::MotionVote>& arcs = drive.navigator().view()->forward;
    const auto best = std::max_element(
        arcs.begin(), arcs.end(), [](const messages::MotionVote& a, const messages::MotionVote& b) {
          return a.waypoint < b.waypoint;
        });
    // Arcs are 2/11 / m apart.
    const double wanted = 0.3 / std::max(0.5 * motion_m, setup.params.drive.step_m);
    EXPECT_NEAR(best->motion.curvature_per_m, std::round(wanted * 5.5) / 5.5, kRounding);
  }
}

// What was felt forbids an arc until the next motion is replaced, ends, or has no safe one after
// it.
TEST(ContinuousPlans, ForgetVetoesWithTheNextMotion) {
  enum class End { kReplaced, kLate, kUnsafe };
  for (const End end : {End::kReplaced, End::kLate, End::kUnsafe}) {
    GestaltSetup setup = SetupOf(DriveCycle::kCsod);
    setup.params.continuous.late_plan = LatePlan::kStopAndLook;
    setup.latency_ticks = end == End::kLate ? 2000 : 0;
    // It feels something after 1.4 m, and backs off far enough to drive round that.
    setup.params.continuous.motion_m = 3.0;
    setup.params.drive.back_off_m = 1.4;
    setup.feels = [](int tick) { return tick == 400; };
    // A wall on the left: arcs that lead there are not safe, and all others lead elsewhere.
    if (end == End::kUnsafe) {
      setup.height = Blocks({{-1.0, 9.0, 1.0, 1.4}});
      setup.params.waypoints.vote_index_variance = 30.0;
    }
    GestaltDrive drive(setup);
    DriveToDecision(drive);
    EXPECT_FALSE(AnyVetoed(*drive.navigator().view()));
    DriveToDecision(drive);
    EXPECT_TRUE(AnyVetoed(*drive.navigator().view())) << "it has backed off";
    if (end == End::kUnsafe) {
      drive.SetGoal({drive.rover().estimate().x_m, 6.0}, GoalChange::kMoved);
    }
    DriveToDecision(drive);
    EXPECT_EQ(AnyVetoed(*drive.navigator().view()), end != End::kLate);
    EXPECT_EQ(drive.navigator().plan_counts().unsafe, end == End::kUnsafe ? 1 : 0);
    DriveToDecision(drive);
    EXPECT_FALSE(AnyVetoed(*drive.navigator().view()));
  }
}

// It backs off along the curvature that it steered when it felt the hazard.
TEST(ContinuousPlans, AreBackedOffFromAlongTheirCurvature) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.goal = {4.0, 4.0};
  setup.feels = [](int tick) { return tick == 100; };
  GestaltDrive drive(setup);
  while (drive.log().size() < 103) drive.Step();
  const messages::MotionCommand& before = drive.log()[99].decision.motion;
  const messages::MotionCommand& back = drive.log()[101].decision.motion;
  EXPECT_EQ(back.direction, -1);
  EXPECT_GT(back.curvature_per_m, 0.05);
  EXPECT_NEAR(back.curvature_per_m, before.curvature_per_m,
              2.0 * setup.rover.tick_distance_m() * before.curvature_rate_per_m2);
}

// A rover that waits at the end of its motion does not go on where the late plan is not safe.
TEST_P(PlansOnTheMove, ThatAreLateAndUnsafeFinishNothing) {
  SeeNearGroundOnly(setup_);  // a blind alley that is seen late
  setup_.height = Blocks({{3.0, 3.4, -1.0, 1.0}, {-1.0, 3.4, 1.0, 1.4}, {-1.0, 3.4, -1.4, -1.0}});
  setup_.params.continuous.no_safe_plan = NoSafePlan::kFinish;
  setup_.params.continuous.motion_m = 0.5;
  setup_.latency_ticks = 120;
  GestaltDrive drive(setup_);
  StepUntil(drive, [&drive] { return drive.navigator().plan_counts().unsafe > 0; });
  const auto& log = drive.log();
  EXPECT_TRUE(log[log.size() - 2].stands()) << "it waits";
  EXPECT_TRUE(log.back().decision.stops_to_look());
}

// A way that was found ends a search: the next one may turn as far again.
TEST(ContinuousPlans, EndASearch) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  SeeNearGroundOnly(setup);
  setup.params.drive.search_turn_rad = math::DegToRad(90.0);
  // No arc leads round it, and none is driven backward.
  setup.params.arcs.max_curvature_per_m = 0.3;
  setup.params.votes.min_fwd_threshold = 0.0;
  // A corner: it is turned to the left by the wall ahead, and then stands before another one.
  setup.height = Blocks({{0.9, 1.3, -2.0, 3.4}, {-4.0, 0.9, 3.0, 3.4}});
  GestaltDrive drive(setup);
  drive.Run(4000);
  EXPECT_GE(Stretches(drive.log(), Turns), 2);
}

}  // namespace
}  // namespace rockyard::navigation
