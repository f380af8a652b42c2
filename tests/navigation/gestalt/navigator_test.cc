// The drive cycle of GESTALT in closed loop with a fake rover.

#include <gtest/gtest.h>

#include "drive.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

using messages::LookDirection;

TEST(GestaltNavigator, ArrivesOnEmptyGround) {
  GestaltSetup setup;
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  const messages::PoseEstimate& end = drive.rover().estimate();
  EXPECT_LE(DistanceToGoal(end, setup.goal), setup.params.waypoints.goal_tolerance_m);
  EXPECT_LT(end.distance_m, 5.0 + 0.05) << "straight";
  EXPECT_EQ(drive.Looks(LookDirection::kBehind), 0);
}

TEST(GestaltNavigator, ArrivesAtGoalsAllAround) {
  for (int k = 0; k < 24; ++k) {
    for (const double distance_m : {0.5, 1.0, 4.0}) {
      GestaltSetup setup;
      const double bearing_rad = math::DegToRad(15.0 * k);
      setup.goal = {distance_m * std::cos(bearing_rad), distance_m * std::sin(bearing_rad)};
      GestaltDrive drive(setup);
      EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived) << 15 * k << " deg, " << distance_m;
    }
  }
}

// Facing away from a goal 7.6 m behind, on empty ground. As printed the whole path counts, so that
// the tight arcs, most of which lie over unseen ground, lose to wide ones that lead away. Pinned to
// a step: what it costs is a limit of the README.
TEST(GestaltNavigator, FacingAwayItTurnsInAWideArcUnlessPathsEndWhereTheyTurnBack) {
  const auto driven_m = [](double heading_deg, double max_path_turn_deg) {
    GestaltSetup setup = TrueSetup();
    setup.goal = {7.6, 0.0};
    setup.start.heading_rad = math::DegToRad(heading_deg);
    setup.params.plan.max_path_turn_rad = math::DegToRad(max_path_turn_deg);
    GestaltDrive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    return drive.rover().estimate().distance_m;
  };
  EXPECT_NEAR(driven_m(0.0, 360.0), 7.4, 0.05);
  EXPECT_NEAR(driven_m(150.0, 360.0), 11.3, 0.35);
  EXPECT_NEAR(driven_m(180.0, 360.0), 12.7, 0.35);
  EXPECT_NEAR(driven_m(150.0, 90.0), 8.8, 0.35);
  EXPECT_NEAR(driven_m(180.0, 90.0), 9.2, 0.35);
}

TEST(GestaltNavigator, DrivesOutOfADeadEnd) {
  GestaltSetup setup;
  setup.rover = TrueRover();  // with the odometry of the other tests it drives to and fro for ever
  setup.height = Blocks({{2.0, 2.4, -1.2, 1.2}, {0.5, 2.4, -1.4, -1.2}, {0.5, 2.4, 1.2, 1.4}});
  for (const bool rear_cameras : {true, false}) {
    setup.params.drive.rear_cameras = rear_cameras;
    GestaltDrive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_EQ(drive.Looks(LookDirection::kBehind) > 0, rear_cameras);
  }
}

// A rover that stands tilted, and above where the estimate has its plane, and knows it: level
// ground is level in its map.
TEST(GestaltNavigator, MapsWhatItSeesFromTheBelievedAttitude) {
  GestaltSetup setup;
  const messages::AttitudeEstimate attitude{0.15, -0.2, 0.3};
  setup.attitude = [&](int) { return attitude; };
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.estimate.distance_m > 1.0; }));
  int seen = 0;
  for (const auto& cell : drive.navigator().view()->map.cells) {
    if (!cell.has_data) continue;
    ++seen;
    ASSERT_NEAR(cell.elevation_m, 0.0, 2e-6) << "points are rounded to 1 um";
  }
  EXPECT_GT(seen, 100);
  EXPECT_EQ(drive.navigator().view()->attitude.roll_rad, attitude.roll_rad);
  EXPECT_EQ(drive.navigator().view()->attitude.z_m, attitude.z_m);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

// The best forward vote after each look ahead, from a map and votes of the test's own.
TEST(GestaltNavigator, LooksBehindExactlyWhereTheBestForwardVoteIsBelowTheThreshold) {
  GestaltSetup setup = TrueSetup();
  setup.height = Blocks({{2.0, 2.4, -1.2, 1.2}, {0.5, 2.4, -1.4, -1.2}, {0.5, 2.4, 1.2, 1.4}});
  setup.params.map.max_idles = 3;  // so that a map that ages by looks, not by cycles, shows
  GestaltDrive drive(setup);
  GestaltMap map(setup.params.map);
  const ArcVoter voter(setup.params);
  int behind = 0;
  int ahead_only = 0;
  while (drive.log().empty() || drive.log().back().decision.status == NavigatorStatus::kDriving) {
    const bool answers = !drive.log().empty() && drive.log().back().decision.looks();
    if (!answers) {
      drive.Step();
      continue;
    }
    const LookDirection asked = *drive.log().back().decision.look;
    const messages::PoseEstimate at = drive.rover().estimate();
    messages::PointCloud cloud{0, asked,
                               setup.range.Look(drive.rover().X_WR(), asked, setup.height)};
    if (asked == LookDirection::kAhead) map.BeginCycle(at.x_m, at.y_m);
    map.Add(cloud, math::MakePose({at.x_m, at.y_m, 0.0}, at.heading_rad, 0.0, 0.0));
    const double best = BestVote(voter.Vote(map.Evaluate(), at, setup.goal).forward);
    const GestaltTick& tick = drive.Step();
    if (tick.moves()) {
      EXPECT_TRUE(HoldSameData(map.View(), drive.navigator().view()->map));
      EXPECT_EQ(drive.navigator().view()->looked_behind, asked == LookDirection::kBehind);
    }
    if (asked == LookDirection::kBehind) continue;
    EXPECT_EQ(tick.looks(LookDirection::kBehind), best < 180.0) << best;
    (best < 180.0 ? behind : ahead_only) += 1;
  }
  EXPECT_GT(behind, 0);
  EXPECT_GT(ahead_only, 10);
}

TEST(GestaltNavigator, RearCamerasOffAreNeverUsed) {
  GestaltSetup setup;
  setup.height = Blocks(Pit());
  setup.params.drive.rear_cameras = false;
  GestaltDrive drive(setup);
  drive.Run();
  EXPECT_EQ(drive.Looks(LookDirection::kBehind), 0);
}

TEST(GestaltNavigator, StepsEndAsMeasured) {
  GestaltSetup setup;
  setup.params.drive.step_m = 0.5;
  GestaltDrive drive(setup);  // its odometer reads 1.05 of what it drives
  drive.Run();
  double begin_m = 0.0;
  int steps = 0;
  bool drove = false;
  double left_m = 5.0;
  for (const GestaltTick& tick : drive.log()) {
    if (!tick.drives() && drove) {
      const double step_m = tick.estimate.distance_m - begin_m;
      const double asked_m = std::min(0.5, left_m);
      ExpectEnds(step_m, asked_m, setup.rover.tick_distance_m());
      ++steps;
    }
    if (!tick.drives()) begin_m = tick.estimate.distance_m;
    if (!tick.drives()) left_m = DistanceToGoal(tick.estimate, setup.goal);
    drove = tick.drives();
  }
  EXPECT_EQ(steps, 10);
}

TEST(GestaltNavigator, ArrivalIsNoticedBetweenStepsOrWhileDriving) {
  GestaltSetup setup{.goal = {1.0, 0.0}};
  GestaltDrive between(setup);
  between.Run();
  // 0.35, 0.70, and 0.30 to the goal itself.
  EXPECT_NEAR(between.rover().estimate().x_m, 1.0, 3.0 * setup.rover.tick_distance_m());
  setup.params.drive.arrival_check = ArrivalCheck::kWhileDriving;
  GestaltDrive driving(setup);
  driving.Run();
  EXPECT_NEAR(driving.rover().estimate().x_m, 0.75, setup.rover.tick_distance_m() + kRounding);
}

TEST(GestaltNavigator, TimeOutEndsTheDrive) {
  GestaltSetup setup;
  setup.params.drive.time_out_s = 12.0;
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  EXPECT_NEAR(drive.log().back().time_s, 12.0, setup.rover.tick_s);
}

TEST(GestaltNavigator, ViewShowsTheLastDecision) {
  GestaltSetup setup;
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.navigator().view(), nullptr);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.drives(); }));
  const messages::NavigationView* view = drive.navigator().view();
  ASSERT_NE(view, nullptr);
  EXPECT_EQ(view->step, 0);
  EXPECT_EQ(view->goal.x_m, setup.goal.x_m);
  EXPECT_EQ(view->map.nx, 50);
  EXPECT_EQ(view->map.cells.size(), 2500u);
  ASSERT_EQ(view->forward.size(), 23u);
  ASSERT_EQ(view->backward.size(), 23u);
  ASSERT_EQ(view->point_turns.size(), 2u);
  EXPECT_TRUE(view->forward[11].chosen);
  EXPECT_EQ(view->forward[11].motion.curvature_per_m, 0.0);
  EXPECT_EQ(std::count_if(view->forward.begin(), view->forward.end(),
                          [](const auto& vote) { return vote.chosen; }),
            1);
  drive.Run();
  EXPECT_EQ(drive.navigator().view()->step + 1, drive.Looks(LookDirection::kAhead));
}

// What GESTALT does where nothing is safe, and what ends it.

// Ground that is an obstacle wherever the rover looks from.
HeightAt Spikes() {
  return [](double x_m, double y_m) {
    const auto i =
        static_cast<long>(std::floor(x_m / 0.2)) + static_cast<long>(std::floor(y_m / 0.2));
    return i % 2 == 0 ? 0.0 : 0.5;
  };
}

// Turns in place of a log, as pairs of measured angle and direction.
std::vector<std::pair<double, int>> Turns(const std::vector<GestaltTick>& log) {
  std::vector<std::pair<double, int>> turns;
  bool turned = false;
  for (std::size_t i = 0; i + 1 < log.size(); ++i) {
    if (log[i].turns()) {
      if (!turned) turns.push_back({0.0, log[i].decision.motion.direction});
      turns.back().first +=
          std::abs(math::WrapAngle(log[i + 1].estimate.heading_rad - log[i].estimate.heading_rad));
    }
    turned = log[i].turns();
  }
  return turns;
}

TEST(GestaltEndings, GivesUpAfterAFullTurnWithoutASafeArc) {
  for (const double side : {-1.0, 1.0}) {
    GestaltSetup setup;
    setup.height = Spikes();
    setup.goal = {4.0, side};
    GestaltDrive drive(setup);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
    EXPECT_EQ(drive.rover().estimate().distance_m, 0.0);
    const auto turns = Turns(drive.log());
    ASSERT_EQ(turns.size(), 4u) << "four of 90 deg";
    for (const auto& [turned_rad, direction] : turns) {
      ExpectEnds(turned_rad, math::DegToRad(90.0), setup.rover.tick_turn_rad());
      EXPECT_EQ(direction, turns[0].second) << "one way";
    }
    EXPECT_EQ(drive.Looks(LookDirection::kAhead), 5);
  }
}

TEST(GestaltEndings, WithoutPointTurnsGivesUpAtOnce) {
  GestaltSetup setup;
  setup.height = Spikes();
  setup.params.drive.point_turns = PointTurns::kNever;
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  EXPECT_EQ(drive.Looks(LookDirection::kAhead), 1);
  EXPECT_TRUE(Turns(drive.log()).empty());
}

// A sensor that sees nothing leaves all ground unknown: a full turn, then a step into the unknown.
TEST(GestaltEndings, UnknownGroundIsDrivenOnlyAfterAFullTurn) {
  GestaltSetup setup{.range = {.range_m = 0.2}};
  for (const double side : {-1.0, 1.0}) {
    setup.goal = {4.0, side};
    GestaltDrive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.drives(); }));
    const auto turns = Turns(drive.log());
    ASSERT_EQ(turns.size(), 4u);
    for (const auto& turn : turns) EXPECT_EQ(turn.second, side) << "towards the goal";
  }
  setup.params.drive.min_drive_goodness = 11.0;
  GestaltDrive careful(setup);
  EXPECT_EQ(careful.Run(), NavigatorStatus::kGaveUp);
  EXPECT_EQ(careful.rover().estimate().distance_m, 0.0);
}

// Four turns of 90 deg overshoot by a tick's share each, 0.017 rad together: a goal 0.005 rad to
// the left is on the right then. A second search is as long as the first, and turns towards it.
TEST(GestaltEndings, EveryDriveEndsASearch) {
  GestaltSetup setup = TrueSetup();
  setup.range.range_m = 0.2;
  setup.goal = {4.0, 0.02};
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::drives));
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::turns));
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::drives));
  const auto turns = Turns(drive.log());
  ASSERT_EQ(turns.size(), 8u);
  for (std::size_t i = 0; i < turns.size(); ++i) EXPECT_EQ(turns[i].second, i < 4 ? +1 : -1) << i;
}

TEST(GestaltEndings, GivesUpInAPitAfterFruitlessCycles) {
  GestaltSetup setup;
  setup.height = Blocks(Pit());
  setup.params.drive.max_fruitless_cycles = 20;
  GestaltDrive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  for (const GestaltTick& tick : drive.log()) {
    EXPECT_LT(std::hypot(tick.X_WR.x_m, tick.X_WR.y_m), 1.2) << "stays inside";
  }
  // Every cycle looks ahead once; the first ones may have made progress.
  EXPECT_GE(drive.Looks(LookDirection::kAhead), 20);
  EXPECT_LE(drive.Looks(LookDirection::kAhead), 30);
}

// A rover that measures no motion whatever it does.
TEST(GestaltEndings, ARoverThatMeasuresNothingGivesUp) {
  for (const bool blocked : {false, true}) {
    GestaltParams params;
    params.drive.max_fruitless_cycles = 5;
    params.drive.step_time_out_s = 10.0;
    GestaltNavigator navigator(params, {5.0, 0.0});
    const HeightAt height = blocked ? Spikes() : Flat();
    NavigatorDecision decision;
    int ticks = 0;
    for (; decision.status == NavigatorStatus::kDriving && ticks < 2000; ++ticks) {
      messages::PointCloud cloud;
      NavigatorInput input{.time_s = 0.1 * ticks, .estimate = {}};
      if (decision.looks()) {
        cloud.direction = *decision.look;
        cloud.points_R = FakeRange{}.Look({}, cloud.direction, height);
        input.cloud = &cloud;
      }
      decision = navigator.Decide(input);
    }
    EXPECT_EQ(decision.status, NavigatorStatus::kGaveUp);
    EXPECT_LT(ticks, 1000);
  }
}

TEST(GestaltEndings, ALookThatIsNotAnsweredIsAskedForAgain) {
  GestaltNavigator navigator({}, {5.0, 0.0});
  for (int i = 0; i < 5; ++i) {
    const NavigatorDecision decision = navigator.Decide({.time_s = 0.1 * i, .estimate = {}});
    EXPECT_EQ(decision.status, NavigatorStatus::kDriving);
    ASSERT_TRUE(decision.looks());
    EXPECT_EQ(*decision.look, LookDirection::kAhead);
  }
}

// The arena reflects the rover's estimate: what was mapped lies elsewhere now.
TEST(GestaltEndings, PoseUpdateForgetsTheMapAndLooksAnew) {
  for (const double jump_m : {0.0, 1.0}) {
    GestaltSetup setup = TrueSetup();
    setup.range.half_angle_rad = math::DegToRad(30.0);
    setup.params.drive.rear_cameras = false;
    GestaltDrive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.estimate.distance_m > 2.0; }));
    const messages::PoseEstimate before = drive.rover().estimate();
    drive.UpdatePose({before.x_m - jump_m, before.y_m + jump_m, 0.0});
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.has_cloud; }));
    const GestaltTick& tick = drive.log().back();
    // A map that never held anything but this cloud.
    GestaltMap fresh(setup.params.map);
    fresh.BeginCycle(tick.estimate.x_m, tick.estimate.y_m);
    fresh.Add({0, LookDirection::kAhead,
               setup.range.Look(tick.X_WR, LookDirection::kAhead, setup.height)},
              math::MakePose({tick.estimate.x_m, tick.estimate.y_m, 0.0}, tick.estimate.heading_rad,
                             0.0, 0.0));
    fresh.Evaluate();
    EXPECT_TRUE(HoldSameData(fresh.View(), drive.navigator().view()->map));
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_LE(DistanceToGoal(drive.rover().estimate(), setup.goal), 0.25);
  }
}

// Four metres that were done are to be done again, in more cycles than may be fruitless.
TEST(GestaltEndings, ProgressIsCountedAnewFromAPoseUpdateOn) {
  GestaltSetup setup;
  setup.params.drive.max_fruitless_cycles = 4;
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.estimate.x_m > 4.0; }));
  drive.UpdatePose({0.0, 0.0, 0.0});
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

// What a search has seen is forgotten by a pose update: it begins anew, the same way round.
TEST(GestaltEndings, PoseUpdateStartsASearchAgain) {
  GestaltSetup setup{.height = Spikes()};
  GestaltDrive drive(setup);
  const auto third = [&drive](const GestaltTick& t) {
    return t.looks(LookDirection::kAhead) && Turns(drive.log()).size() == 3;
  };
  ASSERT_TRUE(drive.StepUntil(third));
  const messages::PoseEstimate& e = drive.rover().estimate();
  drive.UpdatePose({e.x_m, e.y_m, e.heading_rad});
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  EXPECT_EQ(Turns(drive.log()).size(), 7u);
}

TEST(GestaltEndings, PoseUpdateDoesNotChangeTheAngleOfATurnUnderWay) {
  for (const double jump_rad : {0.3, -0.3, 1.5, 3.1}) {
    GestaltSetup setup = TrueSetup();
    setup.height = Spikes();
    GestaltDrive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.turns(); }));
    for (int i = 0; i < 10; ++i) drive.Step();
    const messages::PoseEstimate& e = drive.rover().estimate();
    drive.UpdatePose({e.x_m + 0.4, e.y_m - 0.7, math::WrapAngle(e.heading_rad + jump_rad)});
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); }));
    const double turned_rad = std::abs(drive.rover().X_WR().heading_rad);
    ExpectEnds(turned_rad, math::DegToRad(90.0), setup.rover.tick_turn_rad());
  }
}

TEST(GestaltEndings, PoseUpdateBetweenTwoLooksStartsTheCycleAgain) {
  GestaltSetup setup{.height = Spikes()};
  GestaltDrive drive(setup);
  ASSERT_TRUE(
      drive.StepUntil([](const GestaltTick& t) { return t.looks(LookDirection::kBehind); }));
  drive.UpdatePose({1.0, 1.0, 1.0});
  EXPECT_TRUE(drive.Step().looks(LookDirection::kAhead));
}

}  // namespace
}  // namespace rockyard::navigation
