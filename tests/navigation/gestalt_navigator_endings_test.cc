// What GESTALT does where nothing is safe, and what ends it.
#include <gtest/gtest.h>

#include "gestalt_drive.h"

namespace rockyard::navigation {
namespace {

using messages::LookDirection;

constexpr double kRounding = 1e-9;

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
      EXPECT_GE(turned_rad, math::DegToRad(90.0) - kRounding);
      EXPECT_LE(turned_rad, math::DegToRad(90.0) + setup.rover.tick_turn_rad() + kRounding);
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

TEST(GestaltEndings, GivesUpInAPitAfterFruitlessCycles) {
  GestaltSetup setup;
  setup.height = Blocks({{1.2, 1.6, -1.6, 1.6},
                         {-1.6, -1.2, -1.6, 1.6},
                         {-1.6, 1.6, 1.2, 1.6},
                         {-1.6, 1.6, -1.6, -1.2}});
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
  GestaltSetup setup;
  setup.rover = TrueRover();
  setup.range.half_angle_rad = math::DegToRad(30.0);
  setup.params.drive.rear_cameras = false;
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.estimate.distance_m > 2.0; }));
  const auto known = [](const messages::NavigationView& view) {
    int cells = 0;
    for (const auto& cell : view.map.cells) cells += cell.has_data ? 1 : 0;
    return cells;
  };
  const int before = known(*drive.navigator().view());
  const messages::PoseEstimate& e = drive.rover().estimate();
  drive.UpdatePose({e.x_m - 1.0, e.y_m + 0.5, 0.0});
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.has_cloud; }));
  EXPECT_LT(known(*drive.navigator().view()), before - 10) << "one look's cells only";
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_LE(DistanceToGoal(drive.rover().estimate(), setup.goal), 0.25);
}

TEST(GestaltEndings, PoseUpdateDoesNotChangeTheAngleOfATurnUnderWay) {
  for (const double jump_rad : {0.3, -0.3, 1.5, 3.1}) {
    GestaltSetup setup;
    setup.rover = TrueRover();
    setup.height = Spikes();
    GestaltDrive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.turns(); }));
    for (int i = 0; i < 10; ++i) drive.Step();
    const messages::PoseEstimate& e = drive.rover().estimate();
    drive.UpdatePose({e.x_m + 0.4, e.y_m - 0.7, math::WrapAngle(e.heading_rad + jump_rad)});
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& t) { return t.decision.looks(); }));
    const double turned_rad = std::abs(drive.rover().X_WR().heading_rad);
    EXPECT_GE(turned_rad, math::DegToRad(90.0) - kRounding);
    EXPECT_LE(turned_rad, math::DegToRad(90.0) + setup.rover.tick_turn_rad() + kRounding);
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
