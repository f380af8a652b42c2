// What holds for every navigator decision, over random parameters, reports and poses.

#include <algorithm>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

constexpr std::uint64_t kSeed = 19950501;

// Parameters over the ranges that validation accepts.
PathfinderParams RandomParams(Draws& draws) {
  PathfinderParams p;
  if (draws.Chance(0.3)) {
    p.left_stripes = {0};
    p.centre_stripes = {1, 2, 3};
    p.right_stripes = {4};
  }
  p.turn_direction = static_cast<TurnDirection>(draws.Below(2));
  p.both_sides = static_cast<BothSidesReaction>(draws.Below(3));
  p.right_is_clear = static_cast<RightIsClear>(draws.Below(2));
  p.scan_interval_m = draws.Between(0.01, 0.5);
  p.turn_increment_rad = math::DegToRad(draws.Between(1.0, 90.0));
  p.turn_give_up_rad = math::DegToRad(draws.Between(90.0, 720.0));
  p.clear_distance_m = draws.Chance(0.5) ? 0.0 : draws.Between(0.0, 0.5);
  p.goal_tolerance_m = draws.Between(0.01, 0.5);
  p.heading_deadband_rad = math::DegToRad(draws.Between(0.0, 45.0));
  p.tight_arc_bearing_rad = draws.Between(p.heading_deadband_rad, math::DegToRad(120.0));
  p.point_turn_bearing_rad = draws.Between(p.tight_arc_bearing_rad, math::DegToRad(180.0));
  p.tight_arc_radius_m = draws.Between(0.3, 2.0);
  p.wide_arc_radius_m = draws.Between(p.tight_arc_radius_m, 4.0);
  p.back_off_m = draws.Chance(0.5) ? 0.0 : draws.Between(0.0, 0.3);
  p.threading_m = draws.Chance(0.5) ? 0.0 : draws.Between(0.0, 0.5);
  return p;
}

Stripes RandomStripes(Draws& draws, double hazard_probability) {
  Stripes stripes{};
  for (bool& hazard : stripes) hazard = draws.Chance(hazard_probability);
  return stripes;
}

void ExpectWellFormed(const NavigatorDecision& decision, const PathfinderParams& params) {
  ASSERT_TRUE(std::isfinite(decision.motion.curvature_per_m));
  ASSERT_LE(std::abs(decision.motion.curvature_per_m), 1.0 / params.tight_arc_radius_m + kRounding);
  ASSERT_EQ(std::abs(decision.motion.direction), 1);
  if (decision.status != NavigatorStatus::kDriving) {
    ASSERT_FALSE(decision.looks());
    ASSERT_EQ(decision.motion.kind, messages::MotionKind::kStop);
  } else if (!decision.looks()) {
    ASSERT_NE(decision.motion.kind, messages::MotionKind::kStop) << "drives, looks or ends";
  }
}

// What may follow a hazardous report: a turn, or an extra that is switched on, or the end.
void ExpectReactsToHazard(const Tick& tick, const PathfinderParams& params) {
  if (!tick.drives()) return;
  ASSERT_EQ(tick.decision.motion.curvature_per_m, 0.0);
  if (tick.decision.motion.direction < 0) {
    ASSERT_GT(params.back_off_m, 0.0);
  } else {
    ASSERT_GT(params.threading_m, 0.0);
    ASSERT_EQ(tick.report, kOutermostHazards);
  }
}

// Measured motion without a look at the ground: a scan interval or a threading distance forward,
// and one increment of a turn away from a hazard.
void ExpectLooksOftenEnough(const Drive& drive, const DriveSetup& setup) {
  const std::vector<Tick>& log = drive.log();
  const std::vector<std::size_t> scans = ScanTicks(log);
  ASSERT_FALSE(scans.empty());
  for (std::size_t i = 1; i < scans.size(); ++i) {
    MeasuredMotion forward;
    MeasuredMotion turn;
    for (std::size_t t = scans[i - 1]; t < scans[i]; ++t) {
      const MeasuredMotion motion = MotionBetween(log, t, t + 1);
      if (log[t].drives() && log[t].decision.motion.direction > 0) {
        forward.driven_m += motion.driven_m;
      }
      if (log[t].turns()) turn.turned_rad += motion.turned_rad;
    }
    const Tick& answered = log[scans[i - 1] + 1];
    const bool threads = answered.report == kOutermostHazards;
    const double limit_m =
        std::max(setup.params.scan_interval_m, threads ? setup.params.threading_m : 0.0);
    ASSERT_LE(forward.driven_m, limit_m + setup.rover.tick_distance_m() + kRounding);
    if (answered.report == kClear || threads) continue;
    ASSERT_LE(turn.turned_rad,
              setup.params.turn_increment_rad + setup.rover.tick_turn_rad() + kRounding);
  }
}

TEST(NavigatorProperty, RandomDrivesAreWellFormedAndEnd) {
  for (std::uint32_t trial = 0; trial < 600; ++trial) {
    SCOPED_TRACE(trial);
    Draws draws({kSeed, trial}, 0);
    DriveSetup setup;
    setup.params = RandomParams(draws);
    setup.params.time_out_s = 60.0;
    setup.goal = {draws.Between(-2.0, 2.0), draws.Between(-2.0, 2.0)};
    setup.start = {draws.Between(-2.0, 2.0), draws.Between(-2.0, 2.0), draws.Between(-3.1, 3.1)};
    setup.rover.gyro_scale = draws.Between(0.8, 1.2);
    setup.rover.heading_range = static_cast<HeadingRange>(draws.Below(2));
    const double hazard_probability = draws.Between(0.0, 0.4);
    setup.hazards = [&](const FakeRover&, int scan_number) {
      Draws scan({kSeed, trial}, 1 + static_cast<std::uint32_t>(scan_number));
      return RandomStripes(scan, hazard_probability);
    };
    Drive drive(setup);
    ASSERT_NE(drive.Run(2000), NavigatorStatus::kDriving);
    for (const Tick& tick : drive.log()) {
      ExpectWellFormed(tick.decision, setup.params);
      if (tick.has_report && tick.report != kClear) ExpectReactsToHazard(tick, setup.params);
      if (HasFatalFailure()) return;
    }
    if (drive.log().size() > 1) ExpectLooksOftenEnough(drive, setup);
    if (HasFatalFailure()) return;
    const Tick& last = drive.log().back();
    if (last.decision.status == NavigatorStatus::kArrived) {
      EXPECT_LE(DistanceToGoal(last.estimate, setup.goal), setup.params.goal_tolerance_m);
    }
  }
}

TEST(NavigatorProperty, WallOfRandomHazardsEndsInGivingUpWithoutATimeOut) {
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE(trial);
    Draws draws({kSeed, trial}, 0);
    DriveSetup setup;
    setup.params = RandomParams(draws);
    setup.params.threading_m = 0.0;
    setup.start.heading_rad = draws.Between(-3.1, 3.1);
    setup.hazards = [&](const FakeRover&, int scan_number) {
      Draws scan({kSeed, trial}, 1 + static_cast<std::uint32_t>(scan_number));
      Stripes stripes = RandomStripes(scan, 0.3);
      stripes[static_cast<std::size_t>(scan.Below(messages::kStripes))] = true;
      return stripes;
    };
    Drive drive(setup);
    ASSERT_EQ(drive.Run(50000), NavigatorStatus::kGaveUp);
  }
}

// Estimates that jump at every tick, as no rover moves: decisions stay well-formed.
TEST(NavigatorProperty, JumpingEstimatesKeepDecisionsWellFormed) {
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    Draws draws({kSeed, trial}, 0);
    PathfinderParams params = RandomParams(draws);
    params.time_out_s = 10.0;
    PathfinderNavigator navigator(params, {draws.Between(-5.0, 5.0), 0.0}, draws.Chance(0.8));
    NavigatorDecision decision;
    messages::PoseEstimate estimate;
    for (int i = 0; decision.status == NavigatorStatus::kDriving; ++i) {
      ASSERT_LT(i, 250);
      const messages::PoseEstimate before = estimate;
      estimate = {draws.Between(-9.0, 9.0), draws.Between(-9.0, 9.0), draws.Between(-50.0, 50.0),
                  estimate.distance_m + draws.Between(0.0, 0.5)};
      if (draws.Chance(0.2)) navigator.OnPoseUpdate(before, estimate);
      messages::HazardReport report;
      report.stripe_hazard = RandomStripes(draws, 0.2);
      decision = navigator.Decide({.time_s = 0.05 * i,
                                   .estimate = estimate,
                                   .report = decision.looks() ? &report : nullptr});
      ExpectWellFormed(decision, params);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(NavigatorProperty, EqualInputsGiveEqualDecisions) {
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    Draws draws({kSeed, trial}, 0);
    DriveSetup setup;
    setup.params = RandomParams(draws);
    setup.params.time_out_s = 60.0;
    setup.hazards = [&](const FakeRover&, int scan_number) {
      Draws scan({kSeed, trial}, 1 + static_cast<std::uint32_t>(scan_number));
      return RandomStripes(scan, 0.1);
    };
    Drive a(setup);
    Drive b(setup);
    a.Run(2000);
    b.Run(2000);
    ASSERT_EQ(a.log().size(), b.log().size());
    EXPECT_EQ(a.rover().X_WR().x_m, b.rover().X_WR().x_m);
    EXPECT_EQ(a.rover().X_WR().y_m, b.rover().X_WR().y_m);
    EXPECT_EQ(a.rover().X_WR().heading_rad, b.rover().X_WR().heading_rad);
  }
}

}  // namespace
}  // namespace rockyard::navigation
