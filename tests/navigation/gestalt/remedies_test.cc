// Each remedy in the closed loop, and the same drive without it, which fails.
#include <gtest/gtest.h>

#include <cmath>

#include "drive.h"
#include "navigation/gestalt/drift.h"

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
}

}  // namespace
}  // namespace rockyard::navigation
