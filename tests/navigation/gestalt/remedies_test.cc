// Each remedy in the closed loop, and the same drive without it, which fails.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "drive.h"
#include "grids.h"
#include "navigation/gestalt/drift.h"
#include "navigation/gestalt/turns.h"

namespace rockyard::navigation {
namespace {

struct Result {
  bool arrived = false;
  double driven_m = 0.0;
};

Result DriveTo(const GestaltSetup& setup, int max_ticks = 40000) {
  GestaltDrive drive(setup);
  const bool arrived = drive.Run(max_ticks) == NavigatorStatus::kArrived;
  return {arrived, drive.log().back().estimate.distance_m};
}

// A goal within the tightest circle always lies abeam.
TEST(GestaltRemedies, StopToTurnEndsAnOrbit) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.goal = {0.2, 1.0};
  setup.params.waypoints.goal_tolerance_m = 0.25;
  EXPECT_GT(DriveTo(setup).driven_m, 5.0);
  setup.params.remedies.stop_to_turn.enabled = true;
  const Result turned = DriveTo(setup);
  EXPECT_TRUE(turned.arrived);
  EXPECT_LT(turned.driven_m, 1.1);
}

TEST(GestaltRemedies, TurnFirstSparesAUTurn) {
  for (const DriveCycle cycle : {DriveCycle::kStopAndLook, DriveCycle::kCsod, DriveCycle::kCsad}) {
    GestaltSetup setup = SetupOf(cycle);
    setup.goal = {-5.0, 0.0};
    EXPECT_GT(DriveTo(setup).driven_m, 1.3 * 5.0);
    setup.params.remedies.turn_first.enabled = true;
    const Result turned = DriveTo(setup);
    EXPECT_TRUE(turned.arrived);
    EXPECT_LT(turned.driven_m, 1.05 * 5.0);
  }
}

// Round a wall: the shortest way of the vehicle's centre is that round its end, 0.42 m off.
TEST(GestaltRemedies, CostToGoLeadsRoundAWall) {
  const Block wall{2.5, 2.9, -2.0, 2.6};
  const double shortest_m = 2.0 * std::hypot(2.7, 2.0 + 0.42);
  for (const DriveCycle cycle : {DriveCycle::kStopAndLook, DriveCycle::kCsad}) {
    GestaltSetup setup = SetupOf(cycle);
    setup.goal = {5.4, 0.0};
    setup.height = Blocks({wall});
    EXPECT_GT(DriveTo(setup).driven_m, 1.35 * shortest_m);
    setup.params.remedies.cost_to_go.enabled = true;
    setup.params.remedies.turn_first.enabled = true;
    setup.params.remedies.stop_to_turn.enabled = true;
    const Result round = DriveTo(setup);
    EXPECT_TRUE(round.arrived);
    EXPECT_LT(round.driven_m, 1.2 * shortest_m);
  }
}

// A rover that slides to its right by a fifth of its way, as it is told twice a second.
double LargestSag_m(bool remedied) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsod);
  setup.params.remedies.against_drift.enabled = remedied;
  GestaltDrive drive(setup);
  double sag_m = 0.0;
  double told_m = 0.0;
  while (drive.Step().decision.status == NavigatorStatus::kDriving && drive.log().size() < 10000) {
    if (drive.log().size() % 10 != 0) continue;
    messages::PoseEstimate at = drive.rover().estimate();
    const double slid_m = 0.2 * (at.distance_m - std::exchange(told_m, at.distance_m));
    drive.Correct({.x_m = at.x_m + slid_m * std::sin(at.heading_rad),
                   .y_m = at.y_m - slid_m * std::cos(at.heading_rad),
                   .heading_rad = at.heading_rad});
    sag_m = std::max(sag_m, std::abs(drive.rover().estimate().y_m));
  }
  EXPECT_EQ(drive.log().back().decision.status, NavigatorStatus::kArrived);
  return sag_m;
}

TEST(GestaltRemedies, AgainstDriftKeepsToTheLine) {
  const double sag_m = LargestSag_m(false);
  EXPECT_GT(sag_m, 0.4);
  EXPECT_LT(LargestSag_m(true), 0.6 * sag_m);
}

// The turn in place instead of what leads on by a way of that length.
RemedyTurn TurnInstead(const GoodnessGrid& grid, const messages::Goal& goal,
                       std::optional<double> goes_on_m, double turned_deg = 0.0,
                       bool searches_way = false) {
  GestaltParams params;
  params.continuous.cycle = DriveCycle::kCsad;
  params.remedies.stop_to_turn.enabled = true;
  params.remedies.cost_to_go.enabled = searches_way;
  WayToGo way(params);
  way.Plan(grid, goal, 0.0, 0.0);
  return RemedyTurns(params).InsteadOf(goes_on_m, math::DegToRad(turned_deg), grid, {}, goal, way);
}

TEST(RemedyTurnsTest, ReplaceASplineThatWastesWayOrCircles) {
  const GoodnessGrid open = UniformGrid(kGood);
  const double abeam = 0.5 * std::numbers::pi;
  // Turned to the goal it is 3 m.
  EXPECT_NEAR(TurnInstead(open, {0.0, 3.0}, 3.6).angle_rad, abeam, 1e-9);
  EXPECT_NEAR(TurnInstead(open, {0.0, -3.0}, 3.6).angle_rad, -abeam, 1e-9);
  EXPECT_FALSE(TurnInstead(open, {0.0, 3.0}, 3.4).any());
  EXPECT_NEAR(TurnInstead(open, {4.0, 0.4}, 4.1, 361.0).angle_rad, std::atan2(0.4, 4.0), 1e-9);
  // Within 0.75 m of (0, 1) no circle of 1 m touches the disc of the goal, though the way is short.
  EXPECT_NEAR(TurnInstead(open, {0.25, 0.35}, 0.5).angle_rad, std::atan2(0.35, 0.25), 1e-9);
  EXPECT_FALSE(TurnInstead(open, {0.3, 0.1}, 0.5).any());
  // A rock stands between: the spline is driven, unless it only circles.
  const GoodnessGrid rock = GridWithDisc(0.0, 1.5, 0.5);
  EXPECT_FALSE(TurnInstead(rock, {0.0, 3.0}, 3.6).any());
  EXPECT_GT(TurnInstead(rock, {0.0, 3.0}, 3.6, 361.0).angle_rad, 0.5 * abeam);
}

// A corridor that ends a metre ahead and goes on to the left, unseen behind: no straight drive of
// 1.5 m leads on, but one of half of that.
TEST(RemedyTurnsTest, DoNotTurnBackForWantOfRoom) {
  const GoodnessGrid bend = GridOf([](double x, double y) {
    if (x < 0.0) return kUnknownCell;
    const bool free = (x < 1.0 && std::abs(y) < 0.5) || (x > 0.4 && x < 1.0 && y > 0.0);
    return free ? kGood : kObstacle;
  });
  const RemedyTurn on = TurnInstead(bend, {0.7, 6.0}, std::nullopt, 0.0, true);
  EXPECT_LT(std::abs(on.angle_rad), math::DegToRad(75.0));
  EXPECT_TRUE(on.drives);
  const RemedyTurn back = TurnInstead(bend, {-6.0, 0.0}, std::nullopt, 0.0, true);
  EXPECT_NEAR(std::abs(back.angle_rad), std::numbers::pi, math::DegToRad(10.0));
  EXPECT_FALSE(back.drives);
}

// A turn in place is none on the move: an orbit would end with every one of them.
TEST(GestaltRemedies, TurnsInPlaceAreNoOrbit) {
  GestaltSetup setup = SetupOf(DriveCycle::kCsad);
  setup.goal = {-4.0, 3.0};
  setup.params.remedies.stop_to_turn.enabled = true;
  setup.params.remedies.stop_to_turn.orbit_turn_rad = math::DegToRad(90.0);
  GestaltDrive drive(setup);
  ASSERT_EQ(drive.Run(40000), NavigatorStatus::kArrived);
  int turns = 0;
  for (std::size_t i = 1; i < drive.log().size(); ++i) {
    turns += drive.log()[i].turns() && !drive.log()[i - 1].turns();
  }
  EXPECT_EQ(turns, 1);
}

// Where one side of a turn was felt to be blocked the other way round is left, until it drives.
TEST(SearchTest, TurnsTheOtherWayRoundFromWhatItFelt) {
  Search search(GestaltParams{});
  EXPECT_EQ(search.Round_rad(1.0), 1.0);
  search.Feel(+1);
  EXPECT_DOUBLE_EQ(search.Round_rad(1.0), 1.0 - 2.0 * std::numbers::pi);
  EXPECT_EQ(search.Round_rad(-1.0), -1.0);
  search.Feel(-1);
  EXPECT_EQ(search.Round_rad(1.0), 0.0);
  EXPECT_EQ(search.Round_rad(-1.0), 0.0);
  search.ForgetGround();
  EXPECT_EQ(search.Round_rad(1.0), 1.0);
}

// Turning counts from the last gain, and from the last rest.
TEST(ProgressTest, CountsTurningWithoutProgress) {
  Progress progress(GestaltDriveParams{});
  progress.BeginCycle(10.0);
  for (const double heading_rad : {0.0, 1.0, -1.0}) progress.CountTurn(heading_rad);
  EXPECT_EQ(progress.turned_rad(), 3.0);
  progress.BeginCycle(9.9);
  EXPECT_EQ(progress.turned_rad(), 3.0);
  progress.BeginCycle(9.0);
  EXPECT_EQ(progress.turned_rad(), 0.0);
  progress.CountTurn(0.5);
  EXPECT_EQ(progress.turned_rad(), 1.5);
  progress.Rest();
  progress.CountTurn(3.0);
  EXPECT_EQ(progress.turned_rad(), 0.0);
}

TEST(DriftTest, IsTheSidewaysShareOfTheWay) {
  Drift drift({.enabled = true, .memory_m = 1.0});
  messages::PoseEstimate rover;
  for (int i = 0; i < 100; ++i) {
    rover.distance_m += 0.1;
    drift.Correct(rover, -0.02);
    if (i % 10 == 5) drift.Correct(rover, 0.5);  // a fix
  }
  EXPECT_NEAR(drift.Angle_rad(0.0), std::atan(-0.2), 1e-3);
  // Downhill is to the other side of a rover that has turned about, and ahead of one that faces it.
  EXPECT_NEAR(drift.Angle_rad(math::DegToRad(180.0)), std::atan(0.2), 1e-3);
  EXPECT_NEAR(drift.Angle_rad(math::DegToRad(-90.0)), 0.0, 1e-12);
  // Two metres without any, and what was before counts e^-2.
  for (int i = 0; i < 20; ++i) {
    rover.distance_m += 0.1;
    drift.Correct(rover, 0.0);
  }
  EXPECT_NEAR(drift.Angle_rad(0.0), std::atan(-0.2 * std::exp(-2.0)), 1e-3);
}

}  // namespace
}  // namespace rockyard::navigation
