// Hazard votes (Goldberg 2002, section 4, step 4) computed by hand, and against a plain reference.
#include <gtest/gtest.h>

#include <numbers>

#include "core/random.h"
#include "grids.h"
#include "math/pose.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kAllowed = 10.0;
constexpr messages::Goal kFar{100.0, 0.0};

GestaltParams Exact(double tight_curve_fraction = 1.0) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  params.waypoints.tight_curve_fraction = tight_curve_fraction;
  return params;
}

HazardVote StraightVote(const GoodnessGrid& grid, const std::vector<double>& at_m,
                        const std::vector<double>& weights) {
  std::vector<PathPoint> points;
  for (const double x_m : at_m) points.push_back({x_m, 0.1});
  return VoteOnPath(grid, At(0.0, 0.0, 0.0), points, weights, kAllowed, UnknownCells::kFullWeight);
}

TEST(GestaltPathVote, IsTheWeightedMean) {
  // Goodness 100 up to x = 1, 200 beyond; certainty 255 and 51. Three points, weights 1, 0.5, 0.25:
  // goodness (100 + 100 / 2 + 200 / 4) / 1.75, certainty (255 + 255 / 2 + 51 / 4) / 1.75.
  const GoodnessGrid grid = GridOf([](double x, double) {
    return x < 1.0 ? CellValue{100, 255, true} : CellValue{200, 51, true};
  });
  const HazardVote vote = StraightVote(grid, {0.3, 0.7, 1.5}, {1.0, 0.5, 0.25});
  EXPECT_NEAR(vote.goodness, 200.0 / 1.75, kRounding);
  EXPECT_NEAR(vote.certainty, (255.0 + 127.5 + 12.75) / 1.75, kRounding);
}

TEST(GestaltPathVote, OneCellAtTheLimitBlocksOneAboveDoesNot) {
  for (const int goodness : {9, 10, 11}) {
    const GoodnessGrid grid = GridOf([goodness](double x, double) {
      const bool bad = x > 1.0 && x < 1.2;
      return bad ? CellValue{static_cast<std::uint8_t>(goodness), 255, true} : kGood;
    });
    const HazardVote vote = StraightVote(grid, {0.3, 0.7, 1.1}, {1.0, 1.0, 1.0});
    const double expected = goodness > 10 ? (255.0 + 255.0 + 11.0) / 3.0 : 0.0;
    EXPECT_NEAR(vote.goodness, expected, kRounding) << goodness;
  }
}

// By hand: goodness 100 with certainty 255, 200 with 51 and unknown (11, 0), weights 1, 1/2, 1/4.
TEST(GestaltPathVote, UnknownCellsAtFullWeightOrByCertainty) {
  const GoodnessGrid grid = GridOf([](double x, double) {
    if (x > 2.0) return kUnknownCell;
    return x < 1.0 ? CellValue{100, 255, true} : CellValue{200, 51, true};
  });
  const std::vector<PathPoint> points{{0.5, 0.1}, {1.5, 0.1}, {2.5, 0.1}};
  const std::vector<double> weights{1.0, 0.5, 0.25};
  const auto vote = [&](UnknownCells unknown, std::size_t first) {
    return VoteOnPath(grid, At(0.0, 0.0, 0.0), std::span(points).subspan(first),
                      std::span(weights).subspan(first), kAllowed, unknown);
  };
  const double certainty = (255.0 + 25.5) / 1.75;
  const HazardVote full = vote(UnknownCells::kFullWeight, 0);
  EXPECT_NEAR(full.goodness, (100.0 + 100.0 + 11.0 / 4.0) / 1.75, kRounding);
  EXPECT_NEAR(full.certainty, certainty, kRounding);
  const HazardVote weighed = vote(UnknownCells::kByCertainty, 0);
  EXPECT_NEAR(weighed.goodness, (100.0 * 255.0 + 200.0 * 25.5) / (255.0 + 25.5), kRounding);
  EXPECT_NEAR(weighed.certainty, certainty, kRounding);
  // A path of which nothing is known has what its pair says, and no certainty.
  const HazardVote blank = vote(UnknownCells::kByCertainty, 2);
  EXPECT_EQ(blank.goodness, 11.0);
  EXPECT_EQ(blank.certainty, 0.0);
}

TEST(GestaltPathVote, UnknownEverywhereGivesItsPair) {
  const ArcVoter voter(Exact());
  const MotionVotes votes = voter.Vote(UniformGrid(kUnknownCell), At(0, 0, 0.3), kFar);
  for (const auto* row : {&votes.forward, &votes.backward, &votes.point_turns}) {
    for (const auto& vote : *row) {
      EXPECT_NEAR(vote.hazard, 11.0, kRounding);
      EXPECT_EQ(vote.hazard_certainty, 0.0);
      EXPECT_NEAR(vote.merged, 11.0, kRounding) << "below min-vote-goodness: the lower vote";
    }
  }
}

TEST(GestaltPathVote, GroundOutsideTheWindowIsUnknown) {
  const GoodnessGrid grid = GridOf([](double, double) { return kGood; }, 10);  // 1 m either way
  const HazardVote vote = StraightVote(grid, {0.5, 1.5, 2.5, 3.5}, {1.0, 1.0, 1.0, 1.0});
  EXPECT_NEAR(vote.goodness, (255.0 + 3.0 * 11.0) / 4.0, kRounding);
  EXPECT_NEAR(vote.certainty, 255.0 / 4.0, kRounding);
}

TEST(GestaltPathVote, NearHazardsWeighMoreThanFarOnes) {
  const auto with_patch = [](double x_m) {
    const auto value = [x_m](double x, double) {
      return std::abs(x - x_m) < 0.3 ? CellValue{100, 255, true} : kGood;
    };
    return ArcVoter(Exact()).Vote(GridOf(value), At(0, 0, 0), kFar).forward[11].hazard;
  };
  EXPECT_LT(with_patch(0.9), with_patch(1.7) - 1.0);
  EXPECT_LT(with_patch(1.7), with_patch(2.5) - 1.0);
}

TEST(GestaltPathVote, PathsEndAtTheGoal) {
  // A wall at 2 m blocks a goal beyond it, not one before it.
  const GoodnessGrid grid = GridOf([](double x, double) { return x > 2.0 ? kObstacle : kGood; });
  const ArcVoter voter(Exact());
  EXPECT_EQ(voter.Vote(grid, At(0, 0, 0), {2.5, 0.0}).forward[11].hazard, 0.0);
  EXPECT_NEAR(voter.Vote(grid, At(0, 0, 0), {1.9, 0.0}).forward[11].hazard, 255.0, kRounding);
}

TEST(GestaltPathVote, PathsEndAtPlanMaxDist) {
  const GoodnessGrid grid = GridOf([](double x, double) { return x > 2.0 ? kObstacle : kGood; });
  GestaltParams params = Exact();
  params.plan.plan_max_dist_m = 1.9;
  EXPECT_NEAR(ArcVoter(params).Vote(grid, At(0, 0, 0), kFar).forward[11].hazard, 255.0, kRounding);
}

TEST(GestaltPathVote, CellsBeforePlanMinDistDoNotCount) {
  const GoodnessGrid grid = GridWithDisc(0.0, 0.0, 0.28);
  const MotionVotes votes = ArcVoter(Exact()).Vote(grid, At(0, 0, 0), kFar);
  EXPECT_NEAR(votes.forward[11].hazard, 255.0, kRounding);
  EXPECT_EQ(votes.forward[0].hazard, 0.0) << "the tightest arc comes back to where it began";
}

// The value of a cell found by going through all of them.
CellValue PlainLookUp(const GoodnessGrid& grid, double x_m, double y_m) {
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x0_m = grid.x0_m + ix * grid.xstep_m;
      const double y0_m = grid.y0_m + iy * grid.ystep_m;
      const bool inside =
          x_m >= x0_m && x_m < x0_m + grid.xstep_m && y_m >= y0_m && y_m < y0_m + grid.ystep_m;
      if (inside) return grid.Cell(ix, iy);
    }
  }
  return grid.unknown;
}

// A plain vote: a rover that drives in steps of 0.1 mm (midpoint rule) and reads the map at the
// middle of every half cell.
HazardVote PlainVote(const GoodnessGrid& grid, math::Pose2 pose, double curvature_per_m,
                     int direction, double length_m, const GestaltPlanParams& plan) {
  constexpr int kStepsPerPiece = 1000;
  const double piece_m = 0.5 * grid.xstep_m;
  const double step_m = piece_m / kStepsPerPiece;
  double goodness = 0.0;
  double certainty = 0.0;
  double weights = 0.0;
  bool blocked = false;
  double next_m = plan.plan_min_dist_m + 0.5 * piece_m;
  const int steps = static_cast<int>(std::lround(length_m / step_m));
  for (int i = 0; i < steps; ++i) {
    const double driven_m = (i + 1) * step_m;
    const double middle_rad = pose.heading_rad + 0.5 * direction * curvature_per_m * step_m;
    pose.x_m += direction * step_m * std::cos(middle_rad);
    pose.y_m += direction * step_m * std::sin(middle_rad);
    pose.heading_rad += direction * curvature_per_m * step_m;
    if (driven_m < next_m - 0.5 * step_m) continue;
    const CellValue cell = PlainLookUp(grid, pose.x_m, pose.y_m);
    const double weight = 1.0 - (1.0 - plan.far_weight) * (next_m - plan.plan_min_dist_m) /
                                    (plan.plan_max_dist_m - plan.plan_min_dist_m);
    goodness += weight * cell.goodness;
    certainty += weight * cell.certainty;
    weights += weight;
    blocked = blocked || cell.goodness <= 10;
    next_m += piece_m;
  }
  return {blocked ? 0.0 : goodness / weights, certainty / weights};
}

TEST(GestaltPathVote, AgreesWithAPlainReference) {
  core::RandomStream random({20020309, 0}, core::Purpose::kTest, 0);
  const GestaltParams params = Exact();
  const ArcVoter voter(params);
  for (int trial = 0; trial < 6; ++trial) {
    const GoodnessGrid grid = GridOf([&random](double, double) {
      const double u = random.Uniform();
      if (u < 0.01) return kObstacle;
      return CellValue{static_cast<std::uint8_t>(11.0 + 244.0 * u),
                       static_cast<std::uint8_t>(255.0 * random.Uniform()), true};
    });
    const messages::PoseEstimate pose =
        At(random.Uniform() - 0.5, random.Uniform() - 0.5, 6.0 * random.Uniform() - 3.0);
    const double length_m = trial % 2 == 0 ? 3.0 : 1.7;  // cut by the goal in every other trial
    const messages::Goal goal{pose.x_m + (trial % 2 == 0 ? 50.0 : 1.7), pose.y_m};
    const MotionVotes votes = voter.Vote(grid, pose, goal);
    int blocked = 0;
    for (const auto* row : {&votes.forward, &votes.backward}) {
      for (const auto& vote : *row) {
        const HazardVote plain =
            PlainVote(grid, {pose.x_m, pose.y_m, pose.heading_rad}, vote.motion.curvature_per_m,
                      vote.motion.direction, length_m, params.plan);
        EXPECT_NEAR(vote.hazard, plain.goodness, 1e-6);
        EXPECT_NEAR(vote.hazard_certainty, plain.certainty, 1e-6);
        blocked += vote.hazard == 0.0 ? 1 : 0;
      }
    }
    EXPECT_GT(blocked, 0);
    EXPECT_LT(blocked, 46);
  }
}

// Waypoint votes and merging (Goldberg 2002, section 4, steps 5 and 6).

constexpr double kPi = std::numbers::pi;

TEST(GestaltWaypointVote, PeaksAre255TowardsAnd128Away) {
  const ArcVoter voter(Exact());
  const GoodnessGrid grid = UniformGrid(kGood);
  const MotionVotes ahead = voter.Vote(grid, At(0, 0, 0), {5.0, 0.0});
  EXPECT_EQ(ahead.forward[11].waypoint, 255.0);
  EXPECT_EQ(ahead.backward[11].waypoint, 128.0);
  const MotionVotes behind = voter.Vote(grid, At(0, 0, 0), {-5.0, 0.1});
  double best_forward = 0.0;
  double best_backward = 0.0;
  for (const auto& vote : behind.forward) best_forward = std::max(best_forward, vote.waypoint);
  for (const auto& vote : behind.backward) best_backward = std::max(best_backward, vote.waypoint);
  EXPECT_EQ(best_forward, 128.0);
  EXPECT_EQ(best_backward, 255.0);
  EXPECT_EQ(behind.forward[22].waypoint, 128.0) << "turns left, to where the goal is";
}

TEST(GestaltWaypointVote, AheadReachesTo90DegreesOnEitherSide) {
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(WaypointPeak({1.0, side * (0.5 * kPi - 1e-6)}, +1), 255.0);
    EXPECT_EQ(WaypointPeak({1.0, side * (0.5 * kPi + 1e-6)}, +1), 128.0);
    EXPECT_EQ(WaypointPeak({1.0, side * (0.5 * kPi - 1e-6)}, -1), 128.0);
    EXPECT_EQ(WaypointPeak({1.0, side * (0.5 * kPi + 1e-6)}, -1), 255.0);
  }
}

// 255 exp(-i^2 / (2 * 225)): at one standard deviation, 15 arcs, 255 / sqrt(e).
TEST(GestaltWaypointVote, FallsAsAGaussianOverTheArcIndex) {
  EXPECT_NEAR(WaypointVote(255.0, 15.0, 225.0), 255.0 / std::sqrt(std::numbers::e), kRounding);
  EXPECT_NEAR(WaypointVote(128.0, -15.0, 225.0), 128.0 / std::sqrt(std::numbers::e), kRounding);
  const MotionVotes votes = ArcVoter(Exact()).Vote(UniformGrid(kGood), At(0, 0, 0), {5.0, 0.0});
  for (int i = 0; i < 23; ++i) {
    const double expected = 255.0 * std::exp(-(i - 11) * (i - 11) / 450.0);
    EXPECT_NEAR(votes.forward[static_cast<std::size_t>(i)].waypoint, expected, kRounding);
  }
}

TEST(GestaltWaypointVote, BroadIsTheArcThroughTheGoal) {
  // Drive the arc by its length to the goal: 2 * bearing / curvature.
  for (const double bearing_rad : {-1.2, -0.4, 0.1, 0.9}) {
    const GoalDirection goal{2.0, bearing_rad};
    const double c = BestCurvature(goal, +1, 0.35, Exact(0.0));
    ASSERT_LT(std::abs(c), 2.0);
    const double angle_rad = 2.0 * bearing_rad;
    EXPECT_NEAR(std::sin(angle_rad) / c, 2.0 * std::cos(bearing_rad), kRounding);
    EXPECT_NEAR((1.0 - std::cos(angle_rad)) / c, 2.0 * std::sin(bearing_rad), kRounding);
  }
}

TEST(GestaltWaypointVote, TightTurnsByTheBearingInOneStep) {
  EXPECT_NEAR(BestCurvature({5.0, 0.14}, +1, 0.35, Exact(1.0)), 0.4, kRounding);
  EXPECT_NEAR(BestCurvature({5.0, -0.14}, +1, 0.35, Exact(1.0)), -0.4, kRounding);
  EXPECT_NEAR(BestCurvature({0.2, 0.14}, +1, 0.35, Exact(1.0)), 0.7, kRounding) << "a shorter step";
  EXPECT_EQ(BestCurvature({5.0, 1.5}, +1, 0.35, Exact(1.0)), 2.0) << "no tighter than there is";
}

TEST(GestaltWaypointVote, HalfwayIsTheMeanOfBothCurvatures) {
  const GoalDirection goal{2.0, 0.3};
  const double tight = 0.3 / 0.35;
  const double broad = 2.0 * std::sin(0.3) / 2.0;
  EXPECT_NEAR(BestCurvature(goal, +1, 0.35, Exact(0.5)), 0.5 * (tight + broad), kRounding);
}

// Driven backwards by s, an arc of curvature c turns the rover by -c s.
TEST(GestaltWaypointVote, BackwardTurnsTheFrontOrTheRearToTheGoal) {
  const auto turn_rad = [](double bearing_rad) {
    return -BestCurvature({5.0, bearing_rad}, -1, 0.35, Exact(1.0)) * 0.35;
  };
  EXPECT_NEAR(turn_rad(0.14), 0.14, kRounding) << "goal ahead: the front";
  EXPECT_NEAR(turn_rad(-0.14), -0.14, kRounding);
  EXPECT_NEAR(turn_rad(kPi - 0.14), -0.14, kRounding) << "goal behind: the rear";
  EXPECT_NEAR(turn_rad(-kPi + 0.14), 0.14, kRounding);
}

// Rounding makes such bearings -pi as often as +pi.
TEST(GestaltWaypointVote, AGoalExactlyBehindIsOnTheLeft) {
  for (int k = -12; k <= 12; ++k) {
    const double heading_rad = kPi * k / 12.0;
    const GoalDirection goal = TowardsGoal(
        At(0.0, 0.0, heading_rad), {-5.0 * std::cos(heading_rad), -5.0 * std::sin(heading_rad)});
    EXPECT_NEAR(goal.bearing_rad, kPi, 1e-12) << k;
    EXPECT_GT(BestCurvature(goal, +1, 0.35, {}), 0.0) << k;
  }
  const GoalDirection right = TowardsGoal(At(0.0, 0.0, 0.0), {-5.0, -1e-6});
  EXPECT_LT(right.bearing_rad, 0.0) << "hardly to the right of it is to the right";
}

TEST(GestaltWaypointVote, OfAPointTurnIsThatOfTheStraightArcAfterIt) {
  const MotionVotes votes = ArcVoter(Exact()).Vote(UniformGrid(kGood), At(0, 0, 0), {0.0, 5.0});
  EXPECT_EQ(votes.point_turns[1].waypoint, 255.0) << "left, where the goal is";
  // After the right turn the goal is straight behind: peak 128, best arc tightest, 11 arcs away.
  EXPECT_NEAR(votes.point_turns[0].waypoint, 128.0 * std::exp(-121.0 / 450.0), kRounding);
}

TEST(GestaltWaypointVote, StandingOnTheGoalGivesNumbers) {
  const MotionVotes votes = ArcVoter({}).Vote(UniformGrid(kGood), At(1, 1, 0), {1.0, 1.0});
  for (const auto& vote : votes.forward) EXPECT_TRUE(std::isfinite(vote.merged));
  for (const auto& vote : votes.backward) EXPECT_TRUE(std::isfinite(vote.merged));
}

TEST(GestaltMerge, IsTheMeanByCertainty) {
  // Table 1: waypoint-certainty 192.
  EXPECT_NEAR(MergeVotes({100.0, 255.0}, 255.0, 192.0, 26.0),
              (100.0 * 255.0 + 255.0 * 192.0) / 447.0, kRounding);
  EXPECT_NEAR(MergeVotes({200.0, 0.0}, 128.0, 192.0, 26.0), 128.0, kRounding);
}

TEST(GestaltMerge, IsTheLowerVoteIfEitherIsBelowTheThreshold) {
  EXPECT_EQ(MergeVotes({25.99, 255.0}, 255.0, 192.0, 26.0), 25.99);
  EXPECT_GT(MergeVotes({26.0, 255.0}, 255.0, 192.0, 26.0), 26.0);
  EXPECT_EQ(MergeVotes({255.0, 255.0}, 25.99, 192.0, 26.0), 25.99);
  EXPECT_GT(MergeVotes({255.0, 255.0}, 26.0, 192.0, 26.0), 26.0);
  EXPECT_EQ(MergeVotes({0.0, 255.0}, 10.0, 192.0, 26.0), 0.0);
}

TEST(GestaltMerge, WithoutAnyCertaintyIsTheLowerVote) {
  EXPECT_EQ(MergeVotes({100.0, 0.0}, 200.0, 0.0, 26.0), 100.0);
}

TEST(GestaltVotes, AreWholeNumbersWhereAskedFor) {
  const GoodnessGrid grid = GridOf([](double x, double y) {
    return CellValue{static_cast<std::uint8_t>(100.0 + 20.0 * x + 3.0 * y), 200, true};
  });
  const messages::PoseEstimate pose = At(0.03, 0.04, 0.2);
  const MotionVotes whole = ArcVoter({}).Vote(grid, pose, {5.0, 1.0});
  const MotionVotes exact = ArcVoter(Exact()).Vote(grid, pose, {5.0, 1.0});
  int rounded = 0;
  for (std::size_t i = 0; i < whole.forward.size(); ++i) {
    for (const double vote : {whole.forward[i].hazard, whole.forward[i].hazard_certainty,
                              whole.forward[i].waypoint, whole.forward[i].merged}) {
      EXPECT_EQ(vote, std::floor(vote));
    }
    EXPECT_NEAR(whole.forward[i].hazard, exact.forward[i].hazard, 0.5);
    EXPECT_NEAR(whole.forward[i].waypoint, exact.forward[i].waypoint, 0.5);
    // Half a unit from its own rounding, as much from those of the votes, and from that of the
    // certainty 0.5 |w - h| 192 / (h_c + 192)^2 < 0.1.
    EXPECT_NEAR(whole.forward[i].merged, exact.forward[i].merged, 1.1);
    rounded += whole.forward[i].hazard != exact.forward[i].hazard ? 1 : 0;
  }
  EXPECT_GT(rounded, 0);
}

}  // namespace
}  // namespace rockyard::navigation
