// What holds for every decision of GESTALT, over random parameters, points and poses.
#include <gtest/gtest.h>

#include <limits>

#include "drive.h"

namespace rockyard::navigation {
namespace {

constexpr std::uint64_t kSeed = 20020309;

// Parameters over the ranges that validation accepts.
GestaltParams RandomParams(Draws& draws) {
  GestaltParams p;
  p.arcs.max_curvature_per_m = draws.Between(0.01, 4.0);
  p.arcs.num_forward_arcs = 1 + draws.Below(30);
  p.arcs.num_backward_arcs = draws.Below(30);
  p.arcs.point_turn_amount_rad = math::DegToRad(draws.Between(1.0, 170.0));
  p.arcs.num_point_turns = draws.Below(5);
  p.plan.unknown_cells = static_cast<UnknownCells>(draws.Below(2));
  p.map.step_reference = static_cast<StepReference>(draws.Below(2));
  p.drive.veto_felt = draws.Chance(0.5);
  p.waypoints.tight_curve_fraction = draws.Between(0.0, 1.0);
  p.waypoints.vote_index_variance = draws.Between(0.01, 500.0);
  p.waypoints.waypoint_certainty = draws.Chance(0.1) ? 0.0 : draws.Between(0.0, 255.0);
  p.waypoints.goal_tolerance_m = draws.Between(0.01, 0.5);
  p.plan.plan_min_dist_m = draws.Between(0.0, 1.0);
  p.plan.plan_max_dist_m = p.plan.plan_min_dist_m + draws.Between(0.01, 4.0);
  p.plan.max_path_turn_rad = math::DegToRad(draws.Between(10.0, 400.0));
  p.plan.path_weight = static_cast<PathWeight>(draws.Below(3));
  p.plan.far_weight = draws.Between(0.001, 1.0);
  p.plan.samples_per_cell = 1 + draws.Below(4);
  p.votes.min_allowed_goodness = draws.Between(0.0, 60.0);
  p.votes.min_fwd_threshold = draws.Between(0.0, 256.0);
  p.votes.min_vote_goodness = draws.Between(0.0, 256.0);
  p.votes.whole_numbers = draws.Chance(0.5);
  p.drive.step_m = draws.Between(0.05, 1.0);
  p.drive.rear_cameras = draws.Chance(0.5);
  p.drive.backward_arcs = static_cast<BackwardArcs>(draws.Below(3));
  p.drive.point_turns = static_cast<PointTurns>(draws.Below(4));
  p.drive.min_drive_goodness = draws.Between(0.0, 60.0);
  p.drive.search_turn_rad = math::DegToRad(draws.Between(90.0, 720.0));
  p.drive.max_fruitless_cycles = 1 + draws.Below(20);
  p.drive.max_felt = 1 + draws.Below(5);
  p.drive.back_off_m = draws.Between(0.0, 0.5);
  p.drive.felt_again_m = draws.Between(0.0, 0.5);
  p.drive.arrival_check = static_cast<ArrivalCheck>(draws.Below(2));
  p.drive.step_time_out_s = draws.Between(1.0, 20.0);
  return p;
}

void ExpectSound(const messages::MotionVote& vote) {
  for (const double value : {vote.hazard, vote.hazard_certainty, vote.waypoint, vote.merged}) {
    ASSERT_GE(value, 0.0);
    ASSERT_LE(value, 255.0 + 1e-9);  // means of numbers up to 255, rounded
  }
}

// The motion of the tick after a decision is the chosen candidate, and the only one.
void ExpectIsChosenCandidate(const messages::MotionCommand& motion,
                             const messages::NavigationView& view) {
  int chosen = 0;
  for (const auto* row : {&view.forward, &view.backward, &view.point_turns}) {
    for (const messages::MotionVote& vote : *row) {
      ExpectSound(vote);
      if (!vote.chosen) continue;
      ++chosen;
      ASSERT_TRUE(vote.best);
      ASSERT_EQ(motion.kind, vote.motion.kind);
      ASSERT_EQ(motion.curvature_per_m, vote.motion.curvature_per_m);
      ASSERT_EQ(motion.direction, vote.motion.direction);
    }
  }
  ASSERT_EQ(chosen, 1);
}

// A turn that competes with the arcs by its vote beats those that may be driven.
void ExpectTurnIsWorthIt(const messages::NavigationView& view, const GestaltParams& params) {
  if (params.drive.point_turns != PointTurns::kCandidates) return;
  for (const messages::MotionVote& turn : view.point_turns) {
    if (!turn.chosen) continue;
    for (const messages::MotionVote& arc : view.forward) {
      const bool may_be_driven = arc.hazard > params.drive.min_drive_goodness;
      ASSERT_TRUE(!may_be_driven || turn.merged > arc.merged);
    }
  }
}

void ExpectWellFormed(const NavigatorDecision& decision) {
  ASSERT_TRUE(std::isfinite(decision.motion.curvature_per_m));
  if (decision.status != NavigatorStatus::kDriving) {
    ASSERT_FALSE(decision.looks());
    ASSERT_EQ(decision.motion.kind, messages::MotionKind::kStop);
  } else if (!decision.looks()) {
    ASSERT_NE(decision.motion.kind, messages::MotionKind::kStop) << "drives, looks or ends";
  }
}

messages::PointCloud RandomCloud(Draws& draws, messages::LookDirection direction) {
  messages::PointCloud cloud;
  cloud.direction = direction;
  const int points = draws.Below(6000);
  const double roughness_m = draws.Chance(0.7) ? 0.02 : 0.3;  // good ground, or obstacles
  for (int i = 0; i < points; ++i) {
    cloud.points_R.push_back({draws.Between(-3.0, 3.0), draws.Between(-3.0, 3.0),
                              draws.Between(-roughness_m, roughness_m)});
  }
  if (draws.Chance(0.2)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    cloud.points_R.push_back({nan, 0.0, 1e300});
    cloud.points_R.push_back({0.5, 0.0, std::numeric_limits<double>::infinity()});
  }
  return cloud;
}

// Estimates that jump, updates and touches at any time, points anywhere: decisions stay sound, and
// without any time-out the navigator ends by itself.
TEST(GestaltProperty, RandomWorldsNeverHangAndAlwaysDriveACandidate) {
  int arcs[2] = {0, 0};
  int turns = 0;
  for (std::uint32_t trial = 0; trial < 150; ++trial) {
    SCOPED_TRACE(trial);
    Draws draws({kSeed, trial}, 0);
    const GestaltParams params = RandomParams(draws);
    const double goal_x_m = draws.Between(-5, 5);
    GestaltNavigator navigator(params, {goal_x_m, draws.Between(-5, 5)});
    const double touchy = draws.Between(0.0, 0.2);
    const double tilt = draws.Chance(0.7) ? 0.005 : 0.5;  // the map is a mess where it is large
    NavigatorDecision decision;
    messages::PoseEstimate estimate;
    int ticks = 0;
    for (; decision.status == NavigatorStatus::kDriving; ++ticks) {
      ASSERT_LT(ticks, 100000) << "hangs";
      const messages::PoseEstimate before = estimate;
      const double turn_rad = draws.Between(-1.0, 1.0);
      estimate = {estimate.x_m + draws.Between(-0.1, 0.1), estimate.y_m + draws.Between(-0.1, 0.1),
                  estimate.heading_rad + turn_rad, estimate.distance_m + draws.Between(0.0, 0.2)};
      if (draws.Chance(0.01)) {
        estimate.x_m = draws.Between(-9.0, 9.0);
        navigator.OnPoseUpdate(before, estimate);
      }
      NavigatorInput input{.time_s = 0.5 * ticks, .estimate = estimate};
      input.attitude = {draws.Between(-tilt, tilt), draws.Between(-tilt, tilt),
                        draws.Between(-tilt, tilt)};
      messages::PointCloud cloud;
      if (decision.looks()) {
        cloud = RandomCloud(draws, *decision.look);
        input.cloud = &cloud;
      }
      const messages::VehicleHazard felt{static_cast<messages::VehicleHazardKind>(draws.Below(4)),
                                         static_cast<messages::HazardSide>(draws.Below(3))};
      if (draws.Chance(touchy)) input.vehicle_hazard = &felt;
      input.touches_behind = draws.Chance(touchy);
      decision = navigator.Decide(input);
      ExpectWellFormed(decision);
      const bool begins = input.cloud != nullptr && !decision.looks() &&
                          decision.status == NavigatorStatus::kDriving;
      if (begins) {
        ExpectIsChosenCandidate(decision.motion, *navigator.view());
        ExpectTurnIsWorthIt(*navigator.view(), params);
        const bool arc = decision.motion.kind == messages::MotionKind::kArc;
        ++(arc ? arcs[decision.motion.direction > 0 ? 1 : 0] : turns);
      }
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(arcs[0], 100);
  EXPECT_GT(arcs[1], 100);
  EXPECT_GT(turns, 100);
}

TEST(GestaltProperty, RandomBlocksAreNeverDrivenOverAndDrivesEnd) {
  int arrived = 0;
  for (std::uint32_t trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    Draws draws({kSeed, trial}, 1);
    GestaltSetup setup = TrueSetup();
    setup.params.drive.max_fruitless_cycles = 40;
    setup.goal = {6.0, draws.Between(-1.0, 1.0)};
    std::vector<Block> blocks;
    for (int i = 0; i < 4; ++i) {
      const double x_m = draws.Between(1.2, 4.8);
      const double y_m = draws.Between(-1.5, 1.5);
      blocks.push_back({x_m, x_m + draws.Between(0.2, 0.5), y_m, y_m + draws.Between(0.2, 0.5)});
    }
    setup.height = Blocks(blocks);
    GestaltDrive drive(setup);
    const NavigatorStatus status = drive.Run();
    ASSERT_NE(status, NavigatorStatus::kDriving);
    arrived += status == NavigatorStatus::kArrived ? 1 : 0;
    for (const GestaltTick& tick : drive.log()) {
      // The vehicle's half width, less half a cell, as in the tests by hand.
      for (const Block& block : blocks) {
        ASSERT_FALSE(block.Holds(tick.X_WR.x_m, tick.X_WR.y_m, 0.42 - 0.1));
      }
    }
  }
  EXPECT_GT(arrived, 20) << "most ways are open";
}

TEST(GestaltProperty, EqualInputsGiveEqualDecisions) {
  GestaltSetup setup{.height = Blocks({{2.0, 2.6, -0.5, 0.5}})};
  GestaltDrive a(setup);
  GestaltDrive b(setup);
  a.Run();
  b.Run();
  ASSERT_EQ(a.log().size(), b.log().size());
  EXPECT_EQ(a.rover().X_WR().x_m, b.rover().X_WR().x_m);
  EXPECT_EQ(a.rover().X_WR().heading_rad, b.rover().X_WR().heading_rad);
}

// A mirrored world is driven through in the mirrored way, while no vote is its own mirror image.
TEST(GestaltProperty, MirroredWorldIsDrivenThroughMirrored) {
  GestaltSetup setup = TrueSetup();
  setup.goal = {5.0, 0.7};
  setup.height = Blocks({{2.0, 2.6, -0.3, 0.5}});
  GestaltDrive drive(setup);
  setup.goal = {5.0, -0.7};
  setup.height = Blocks({{2.0, 2.6, -0.5, 0.3}});
  GestaltDrive mirrored(setup);
  drive.Run();
  mirrored.Run();
  ASSERT_EQ(drive.log().size(), mirrored.log().size());
  EXPECT_NEAR(drive.rover().X_WR().x_m, mirrored.rover().X_WR().x_m, 1e-9);
  EXPECT_NEAR(drive.rover().X_WR().y_m, -mirrored.rover().X_WR().y_m, 1e-9);
}

}  // namespace
}  // namespace rockyard::navigation
