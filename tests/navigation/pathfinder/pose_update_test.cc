// Operators correct the estimate while a manoeuvre is under way: what has been measured of the
// manoeuvre stays measured.
#include <gtest/gtest.h>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

constexpr double kRounding = 1e-9;

messages::PoseUpdate Shifted(const messages::PoseEstimate& estimate, double jump_rad) {
  return {estimate.x_m + 0.4, estimate.y_m - 0.7, math::WrapAngle(estimate.heading_rad + jump_rad)};
}

// True turn of the rover over a log, in the gyro's scale.
double TurnedByGyro(const std::vector<Tick>& log, double gyro_scale) {
  double turned_rad = 0.0;
  for (std::size_t i = 0; i + 1 < log.size(); ++i) {
    turned_rad += gyro_scale * std::abs(log[i + 1].X_WR.heading_rad - log[i].X_WR.heading_rad);
  }
  return turned_rad;
}

TEST(PoseUpdate, DoesNotChangeTheAngleOfATurnUnderWay) {
  for (const Stripes& stripes : {kLeftHazard, kRightHazard}) {
    for (const double jump_rad : {0.0, 0.3, -0.3, 1.5, -1.5, 3.1}) {
      SCOPED_TRACE(jump_rad);
      DriveSetup setup;
      setup.params.turn_increment_rad = math::DegToRad(40.0);
      setup.hazards = Always(stripes);
      Drive drive(setup);
      for (int i = 0; i < 12; ++i) drive.Step();
      ASSERT_TRUE(drive.log().back().turns());
      drive.UpdatePose(Shifted(drive.rover().estimate(), jump_rad));
      ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.decision.looks(); }, 200));
      const double turned_rad = TurnedByGyro(drive.log(), setup.rover.gyro_scale);
      EXPECT_GE(turned_rad, setup.params.turn_increment_rad - kRounding);
      EXPECT_LE(turned_rad,
                setup.params.turn_increment_rad + setup.rover.tick_turn_rad() + kRounding);
    }
  }
}

TEST(PoseUpdate, DoesNotChangeTheGiveUpAngle) {
  DriveSetup setup;
  setup.hazards = Always(kLeftHazard);
  Drive drive(setup);
  while (drive.log().empty() || drive.log().back().decision.status == NavigatorStatus::kDriving) {
    ASSERT_LT(drive.log().size(), 5000u);
    drive.Step();
    if (drive.log().size() % 17 == 0) {
      drive.UpdatePose(Shifted(drive.rover().estimate(), 2.0));
    }
  }
  EXPECT_EQ(drive.log().back().decision.status, NavigatorStatus::kGaveUp);
  const double turned_rad = TurnedByGyro(drive.log(), setup.rover.gyro_scale);
  EXPECT_GE(turned_rad, setup.params.turn_give_up_rad - kRounding);
  EXPECT_LE(turned_rad, setup.params.turn_give_up_rad + setup.params.turn_increment_rad +
                            setup.rover.tick_turn_rad() + kRounding);
}

TEST(PoseUpdate, DoesNotChangeTheDistanceBetweenScans) {
  DriveSetup setup;
  Drive drive(setup);
  for (int i = 0; i < 2000; ++i) {
    drive.Step();
    if (i == 150) drive.UpdatePose({0.2, 0.5, -0.4});
    if (drive.log().back().decision.status != NavigatorStatus::kDriving) break;
  }
  const std::vector<std::size_t> scans = ScanTicks(drive.log());
  ASSERT_GT(scans.size(), 50u);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    const double driven_m =
        drive.log()[scans[i]].estimate.distance_m - drive.log()[scans[i - 1]].estimate.distance_m;
    EXPECT_GE(driven_m, setup.params.scan_interval_m - kRounding);
    EXPECT_LE(driven_m, setup.params.scan_interval_m + setup.rover.tick_distance_m() + kRounding);
  }
}

TEST(PoseUpdate, DoesNotChangeTheStraightDriveAfterATurn) {
  DriveSetup setup;
  setup.params.clear_distance_m = 0.2;
  setup.hazards = Sequence({kLeftHazard, kLeftHazard, kLeftHazard});
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.estimate.distance_m > 0.03; }));
  drive.UpdatePose({0.4, -0.6, -1.2});
  ASSERT_TRUE(drive.StepUntil(
      [](const Tick& t) { return t.drives() && t.decision.motion.curvature_per_m != 0.0; }));
  EXPECT_GE(drive.log().back().estimate.distance_m, 0.2 - kRounding);
  EXPECT_LE(drive.log().back().estimate.distance_m, 0.2 + 2.0 * setup.rover.tick_distance_m());
}

TEST(PoseUpdate, SteersByTheNewEstimate) {
  DriveSetup setup;
  setup.start = {0.0, 0.0, 0.4};  // the goal lies to the right
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.drives(); }));
  EXPECT_LT(drive.log().back().decision.motion.curvature_per_m, 0.0);
  drive.UpdatePose({0.0, 0.0, -0.4});  // and now to the left
  ASSERT_TRUE(drive.StepUntil([](const Tick& t) { return t.has_report; }));
  EXPECT_GT(drive.log().back().decision.motion.curvature_per_m, 0.0);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

TEST(PoseUpdate, DuringATurnTowardsTheGoalEndsFacingTheGoal) {
  for (const double heading_rad : {1.9, -1.9, 3.0}) {
    DriveSetup setup;
    setup.start = {0.0, 0.0, math::DegToRad(160.0)};
    Drive drive(setup);
    for (int i = 0; i < 8; ++i) drive.Step();
    ASSERT_TRUE(drive.log().back().turns());
    drive.UpdatePose({0.0, 0.0, heading_rad});
    EXPECT_EQ(drive.Run(20000), NavigatorStatus::kArrived);
  }
}

}  // namespace
}  // namespace rockyard::navigation
