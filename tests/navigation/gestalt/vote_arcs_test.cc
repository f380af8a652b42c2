// Candidate motions against their closed forms; mirrored and turned worlds give mirrored and the
// same choices.

#include <gtest/gtest.h>

#include <numbers>

#include "core/random.h"
#include "grids.h"
#include "navigation/gestalt/arcs.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kCell_m = 0.2;

CandidateMotions Defaults(const PathSampling& sampling) { return MakeCandidates({}, {}, sampling); }

TEST(GestaltArcs, CurvaturesAreSpacedEvenlyFromRightToLeft) {
  // Table 1: 23 arcs up to 2.0 per metre; spacing 4 / 22.
  for (std::size_t i = 0; i < 23; ++i) {
    EXPECT_NEAR(ArcCurvature(i, 23, 2.0), -2.0 + static_cast<double>(i) * 4.0 / 22.0, kRounding);
    EXPECT_EQ(ArcCurvature(i, 23, 2.0), -ArcCurvature(22 - i, 23, 2.0)) << "mirrored exactly";
  }
  EXPECT_EQ(ArcCurvature(11, 23, 2.0), 0.0);
  EXPECT_EQ(ArcCurvature(0, 1, 2.0), 0.0);
}

TEST(GestaltArcs, TableOneCountsAndDirections) {
  const CandidateMotions motions = Defaults(SamplePaths({}, kCell_m));
  ASSERT_EQ(motions.forward.size(), 23u);
  ASSERT_EQ(motions.backward.size(), 23u);
  ASSERT_EQ(motions.point_turns.size(), 2u);
  for (const auto& arc : motions.forward) EXPECT_EQ(arc.motion.direction, +1);
  for (const auto& arc : motions.backward) EXPECT_EQ(arc.motion.direction, -1);
  EXPECT_NEAR(motions.point_turns[0].turn_rad, -0.5 * std::numbers::pi, kRounding);
  EXPECT_NEAR(motions.point_turns[1].turn_rad, +0.5 * std::numbers::pi, kRounding);
}

TEST(GestaltArcs, SamplesLieInTheMiddlesOfPiecesFromPlanMinToPlanMax) {
  const PathSampling sampling = SamplePaths({}, kCell_m);
  // Pieces of 0.1 m from 0.3 m to 3.0 m: 0.35, 0.45 ... 2.95.
  ASSERT_EQ(sampling.distance_m.size(), 27u);
  EXPECT_NEAR(sampling.distance_m.front(), 0.35, kRounding);
  EXPECT_NEAR(sampling.distance_m.back(), 2.95, kRounding);
  EXPECT_EQ(sampling.CountWithin(100.0), 27u);
  EXPECT_EQ(sampling.CountWithin(1.0), 7u);  // 0.35 ... 0.95
  EXPECT_EQ(sampling.CountWithin(0.1), 1u) << "one point at least";
}

TEST(GestaltArcs, WeightsFallAsTheyAreNamed) {
  GestaltPlanParams plan{.far_weight = 0.2};
  const PathSampling linear = SamplePaths(plan, kCell_m);
  plan.path_weight = PathWeight::kInverse;
  const PathSampling inverse = SamplePaths(plan, kCell_m);
  plan.path_weight = PathWeight::kUniform;
  const PathSampling uniform = SamplePaths(plan, kCell_m);
  for (std::size_t k = 0; k < linear.weight.size(); ++k) {
    const double s_m = linear.distance_m[k];
    EXPECT_NEAR(linear.weight[k], 1.0 - 0.8 * (s_m - 0.3) / 2.7, kRounding);
    EXPECT_NEAR(inverse.weight[k] * s_m, inverse.weight[0] * inverse.distance_m[0], kRounding);
    EXPECT_EQ(uniform.weight[k], 1.0);
  }
}

// Points of an arc of curvature c lie on the circle about (0, 1/c), at the angle c s from its
// start.
TEST(GestaltArcs, PointsLieOnTheirCircle) {
  const PathSampling sampling = SamplePaths({}, kCell_m);
  const CandidateMotions motions = Defaults(sampling);
  for (const auto* row : {&motions.forward, &motions.backward}) {
    for (const CandidateMotion& arc : *row) {
      const double c = arc.motion.curvature_per_m;
      ASSERT_EQ(arc.points.size(), sampling.distance_m.size());
      for (std::size_t k = 0; k < arc.points.size(); ++k) {
        const double s_m = arc.motion.direction * sampling.distance_m[k];
        if (c == 0.0) {
          EXPECT_EQ(arc.points[k].x_m, s_m);
          EXPECT_EQ(arc.points[k].y_m, 0.0);
          continue;
        }
        EXPECT_NEAR(std::hypot(arc.points[k].x_m, arc.points[k].y_m - 1.0 / c), 1.0 / std::abs(c),
                    1e-9);
        EXPECT_NEAR(
            std::remainder(std::atan2(c * arc.points[k].x_m, 1.0 - c * arc.points[k].y_m) - c * s_m,
                           2.0 * std::numbers::pi),
            0.0, 1e-9);
      }
    }
  }
}

TEST(GestaltArcs, ArcsEndWhereTheyHaveTurnedEnough) {
  GestaltPlanParams plan{.max_path_turn_rad = 0.5 * std::numbers::pi};
  const PathSampling sampling = SamplePaths(plan, kCell_m);
  const CandidateMotions motions = MakeCandidates({}, plan, sampling);
  // The tightest arc turns 90 deg over pi/4 m = 0.785 m: points at 0.35 ... 0.75.
  EXPECT_EQ(motions.forward.front().points.size(), 5u);
  EXPECT_EQ(motions.forward[11].points.size(), 27u);
}

TEST(GestaltArcs, ArcsThatTurnTooFastAreJudgedAtTheirFirstPoint) {
  GestaltArcParams arcs{.max_curvature_per_m = 20.0};
  GestaltPlanParams plan{.max_path_turn_rad = 0.2};
  const CandidateMotions motions = MakeCandidates(arcs, plan, SamplePaths(plan, 0.2));
  EXPECT_EQ(motions.forward.front().points.size(), 1u) << "7 rad at 0.35 m";
}

TEST(GestaltArcs, NearestArcIsThatOfTheLeastDifference) {
  for (const std::size_t count : {1u, 2u, 5u, 22u, 23u}) {
    for (double c = -2.53; c < 2.6; c += 0.0371) {
      const std::size_t nearest = NearestArc(c, count, 2.0);
      ASSERT_LT(nearest, count);
      for (std::size_t i = 0; i < count; ++i) {
        EXPECT_LE(std::abs(ArcCurvature(nearest, count, 2.0) - c),
                  std::abs(ArcCurvature(i, count, 2.0) - c) + kRounding);
      }
    }
  }
}

TEST(GestaltArcs, NearestArcOfMirroredCurvatureIsMirrored) {
  for (int k = -40; k <= 40; ++k) {
    // Multiples of half a spacing: every other one is halfway between two arcs.
    const double c = k * 2.0 / 22.0;
    EXPECT_EQ(NearestArc(c, 23, 2.0), 22 - NearestArc(-c, 23, 2.0)) << c;
  }
  EXPECT_EQ(NearestArc(0.0, 22, 2.0), 10u) << "the right one of two in the middle";
}

// Cells longer than wide: the shorter side counts, whichever it is.
TEST(GestaltArcs, PathsAreSampledByTheShorterSideOfACell) {
  for (const bool short_x : {false, true}) {
    GestaltParams params;
    params.map.grid.xstep_m = short_x ? 0.1 : 0.4;
    params.map.grid.ystep_m = short_x ? 0.4 : 0.1;
    const ArcVoter voter(params);
    EXPECT_NEAR(voter.sampling().distance_m[1] - voter.sampling().distance_m[0], 0.05, 1e-12);
  }
}

constexpr double kPi = std::numbers::pi;

struct Disc {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 0.0;
};

std::vector<Disc> RandomDiscs(core::RandomStream& random) {
  std::vector<Disc> discs;
  for (int i = 0; i < 6; ++i) {
    discs.push_back(
        {6.0 * random.Uniform() - 3.0, 6.0 * random.Uniform() - 3.0, 0.2 + 0.5 * random.Uniform()});
  }
  return discs;
}

GoodnessGrid GridOfDiscs(const std::vector<Disc>& discs) {
  return GridOf([&discs](double x, double y) {
    for (const Disc& disc : discs) {
      if (std::hypot(x - disc.x_m, y - disc.y_m) <= disc.radius_m) return kObstacle;
    }
    return kGood;
  });
}

std::vector<messages::MotionVote>& RowOf(MotionVotes& votes, const messages::MotionVote& arc) {
  return arc.motion.direction > 0 ? votes.forward : votes.backward;
}

TEST(GestaltSymmetry, MirroredWorldGivesTheMirroredChoice) {
  core::RandomStream random({19, 0}, core::Purpose::kTest, 0);
  const GestaltParams params;
  const ArcVoter voter(params);
  int off_centre = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Disc> discs = RandomDiscs(random);
    const double y_m = 0.4 * random.Uniform() - 0.2;
    const double heading_rad = 2.0 * random.Uniform() - 1.0;
    const messages::Goal goal{3.0 * random.Uniform() + 1.0, 4.0 * random.Uniform() - 2.0};
    MotionVotes votes = voter.Vote(GridOfDiscs(discs), At(0.1, y_m, heading_rad), goal);
    for (Disc& disc : discs) disc.y_m = -disc.y_m;
    MotionVotes mirrored =
        voter.Vote(GridOfDiscs(discs), At(0.1, -y_m, -heading_rad), {goal.x_m, -goal.y_m});
    for (std::size_t i = 0; i < 23; ++i) {
      ASSERT_EQ(votes.forward[i].merged, mirrored.forward[22 - i].merged);
      ASSERT_EQ(votes.backward[i].merged, mirrored.backward[22 - i].merged);
    }
    ASSERT_EQ(votes.point_turns[0].merged, mirrored.point_turns[1].merged);
    const messages::MotionVote* arc = ChooseArc(votes, params);
    const messages::MotionVote* other = ChooseArc(mirrored, params);
    ASSERT_EQ(arc == nullptr, other == nullptr);
    if (arc == nullptr) continue;
    EXPECT_EQ(arc->motion.direction, other->motion.direction);
    EXPECT_EQ(arc->motion.curvature_per_m, -other->motion.curvature_per_m);
    off_centre += arc->motion.curvature_per_m != 0.0 ? 1 : 0;
  }
  EXPECT_GT(off_centre, 50) << "the worlds are not symmetrical";
}

// A turn of the world by a right angle maps cells on cells: the votes are the same.
TEST(GestaltSymmetry, WorldTurnedByARightAngleGivesTheSameChoice) {
  core::RandomStream random({20, 0}, core::Purpose::kTest, 0);
  const GestaltParams params;
  const ArcVoter voter(params);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Disc> discs = RandomDiscs(random);
    const messages::PoseEstimate pose =
        At(0.1, 0.4 * random.Uniform() - 0.2, 2.0 * random.Uniform() - 1.0);
    const messages::Goal goal{3.0 * random.Uniform() + 1.0, 4.0 * random.Uniform() - 2.0};
    MotionVotes votes = voter.Vote(GridOfDiscs(discs), pose, goal);
    for (Disc& disc : discs) disc = {-disc.y_m, disc.x_m, disc.radius_m};
    MotionVotes turned =
        voter.Vote(GridOfDiscs(discs), At(-pose.y_m, pose.x_m, pose.heading_rad + 0.5 * kPi),
                   {-goal.y_m, goal.x_m});
    const messages::MotionVote* arc = ChooseArc(votes, params);
    const messages::MotionVote* other = ChooseArc(turned, params);
    ASSERT_EQ(arc == nullptr, other == nullptr);
    if (arc == nullptr) continue;
    EXPECT_EQ(arc->merged, other->merged);
    EXPECT_EQ(arc - RowOf(votes, *arc).data(), other - RowOf(turned, *other).data());
  }
}

// Smooth goodness of the place, seen from a world turned by `turn_rad`.
GoodnessGrid SmoothGrid(double turn_rad) {
  return GridOf([turn_rad](double x, double y) {
    const double u = std::cos(turn_rad) * x + std::sin(turn_rad) * y;
    const double v = -std::sin(turn_rad) * x + std::cos(turn_rad) * y;
    const double goodness = 150.0 + 50.0 * std::sin(1.1 * u) * std::cos(0.9 * v);
    return CellValue{static_cast<std::uint8_t>(std::lround(goodness)), 255, true};
  });
}

// At other angles the world is cut into other cells. A point is at most step / sqrt(2) from the
// centre of its cell and the goodness changes by at most 50 * 1.1 * sqrt(2) = 78 per metre, so that
// no cell under a path, and no mean over them, differs by more than 2 * 0.1414 * 78 + 1 (rounding)
// = 23 from one world to the other; hazard votes that close choose arcs whose merged votes differ
// by no more than 2 * 255 / 447 * 23 = 27.
TEST(GestaltSymmetry, TurnedWorldGivesTheChoiceUpToTheCells) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  const ArcVoter voter(params);
  MotionVotes votes = voter.Vote(SmoothGrid(0.0), At(0, 0, 0.1), {4.0, 1.0});
  const auto index = ChooseArc(votes, params) - votes.forward.data();
  double largest = 0.0;
  for (double turn_rad = 0.1; turn_rad < 6.2; turn_rad += 0.1) {
    const double c = std::cos(turn_rad);
    const double s = std::sin(turn_rad);
    MotionVotes turned =
        voter.Vote(SmoothGrid(turn_rad), At(0, 0, 0.1 + turn_rad), {4.0 * c - s, 4.0 * s + c});
    for (std::size_t i = 0; i < 23; ++i) {
      const double difference = std::abs(turned.forward[i].hazard - votes.forward[i].hazard);
      EXPECT_LT(difference, 23.0);
      largest = std::max(largest, difference);
      EXPECT_NEAR(turned.forward[i].waypoint, votes.forward[i].waypoint, 1e-9);
    }
    const messages::MotionVote* other = ChooseArc(turned, params);
    ASSERT_NE(other, nullptr);
    EXPECT_GE(votes.forward[static_cast<std::size_t>(other - turned.forward.data())].merged,
              votes.forward[static_cast<std::size_t>(index)].merged - 27.0);
    EXPECT_NEAR(static_cast<double>(other - turned.forward.data()), static_cast<double>(index),
                2.0);
  }
  EXPECT_GT(largest, 0.1) << "the cells do differ";
}

}  // namespace
}  // namespace rockyard::navigation
