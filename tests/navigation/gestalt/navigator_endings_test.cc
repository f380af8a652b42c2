// What GESTALT does where nothing is safe, and what ends it.
#include <gtest/gtest.h>

#include "drive.h"

namespace rockyard::navigation {
namespace {

using messages::LookDirection;

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
  GestaltSetup setup;
  setup.range.range_m = 0.2;
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
  GestaltSetup setup;
  setup.height = Spikes();
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
  GestaltSetup setup;
  setup.height = Spikes();
  GestaltDrive drive(setup);
  ASSERT_TRUE(
      drive.StepUntil([](const GestaltTick& t) { return t.looks(LookDirection::kBehind); }));
  drive.UpdatePose({1.0, 1.0, 1.0});
  EXPECT_TRUE(drive.Step().looks(LookDirection::kAhead));
}

}  // namespace
}  // namespace rockyard::navigation
