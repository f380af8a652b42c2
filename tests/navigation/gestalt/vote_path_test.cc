// Hazard votes (Goldberg 2002, section 4, step 4) computed by hand, and against a plain reference.
#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "grids.h"
#include "math/pose.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kAllowed = 10.0;
constexpr messages::Goal kFar{100.0, 0.0};

GestaltParams Exact() {
  GestaltParams params;
  params.votes.whole_numbers = false;
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
      const double v = random.Uniform();
      return CellValue{static_cast<std::uint8_t>(11.0 + 244.0 * u),
                       static_cast<std::uint8_t>(255.0 * v), true};
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

}  // namespace
}  // namespace rockyard::navigation
