// Votes on splines: closed forms, rocks, unknown ground, near goals, limits, mirrored worlds; and
// which spline is chosen.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/random.h"
#include "grids.h"
#include "navigation/gestalt/splines.h"

namespace rockyard::navigation {
namespace {

using messages::SplineVote;

constexpr double kFullSpeed_m_s = 0.07;

// The spline of these knots, from right to left, of 15 each.
std::size_t IndexOf(int first, int second) { return static_cast<std::size_t>(15 * first + second); }

constexpr int kStraight = 7;

SplineVotes VotesOn(const GoodnessGrid& grid, const messages::Goal& goal,
                    const GestaltParams& params = {}, double curvature_per_m = 0.0,
                    const messages::PoseEstimate& start = {}) {
  return SplineVoter(params, kFullSpeed_m_s).Vote(grid, start, curvature_per_m, goal);
}

TEST(GestaltSplineVotes, Are225FromRightToLeft) {
  const SplineVotes votes = VotesOn(UniformGrid(kGood), {9.0, 0.0}, {}, 0.3);
  ASSERT_EQ(votes.size(), 225u);
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j < 15; ++j) {
      const Spline& spline = votes[IndexOf(i, j)].spline;
      EXPECT_EQ(spline.start_per_m, 0.3);
      EXPECT_NEAR(spline.first_knot_per_m, (i - 7) / 7.0, 1e-15);
      EXPECT_NEAR(spline.second_knot_per_m, (j - 7) / 7.0, 1e-15);
      EXPECT_EQ(spline.length_m, 3.0);
    }
  }
}

// On good ground hazard votes and certainties are 255, and the spline that goes straight to the
// goal has all that there is.
TEST(GestaltSplineVotes, GoodGroundLeadsToTheGoal) {
  const SplineVotes votes = VotesOn(UniformGrid(kGood), {9.0, 0.0});
  for (const SplineVote& vote : votes) {
    EXPECT_EQ(vote.hazard, 255.0);
    EXPECT_EQ(vote.hazard_certainty, 255.0);
    EXPECT_TRUE(vote.feasible);
    EXPECT_FALSE(vote.chosen);
  }
  const SplineVote* chosen = ChooseSpline(votes, {});
  EXPECT_EQ(chosen, &votes[IndexOf(kStraight, kStraight)]);
  EXPECT_EQ(chosen->waypoint, 255.0);
  EXPECT_EQ(chosen->waypoint_error_rad, 0.0);
  EXPECT_EQ(chosen->merged, 255.0);
}

// A spline whose curvatures are all c is an arc: after w its place is (sin(c w), 1 - cos(c w)) / c
// and its heading c w.
TEST(GestaltSplineVotes, WaypointVoteFallsWithTheAngleThatMissesTheGoal) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  const messages::Goal goal{6.0, 2.0};
  for (const double step_m : {0.35, 0.7}) {
    params.drive.step_m = step_m;
    for (const double waypoint_m : {0.5, 1.5, 2.0, 3.0}) {
      params.splines.waypoint_m = waypoint_m;
      for (const int knot : {0, 3, 10, 14}) {
        const double c = (knot - 7) / 7.0;
        const SplineVotes votes = VotesOn(UniformGrid(kGood), goal, params, c);
        const SplineVote& vote = votes[IndexOf(knot, knot)];
        const double x = goal.x_m - std::sin(c * waypoint_m) / c;
        const double y = goal.y_m - (1.0 - std::cos(c * waypoint_m)) / c;
        const double bearing =
            std::remainder(std::atan2(y, x) - c * waypoint_m, 2.0 * std::numbers::pi);
        EXPECT_NEAR(vote.waypoint_error_rad, bearing, 1e-11);
        // A disc of 0.25 m.
        const double e = std::max(0.0, std::abs(bearing) - std::asin(0.25 / std::hypot(x, y)));
        // 23 arcs within +-2 / m: spacing 2/11 / m; variance 225.
        const double index = e / (step_m * 2.0 / 11.0);
        EXPECT_NEAR(vote.waypoint, 255.0 * std::exp(-index * index / 450.0), 1e-9);
        // Step 6: the lower one below 26, else hazard vote 255 of certainty 255 with waypoint
        // certainty 192.
        const double merged = (255.0 * 255.0 + vote.waypoint * 192.0) / 447.0;
        EXPECT_NEAR(vote.merged, vote.waypoint < 26.0 ? vote.waypoint : merged, 1e-9);
      }
    }
  }
}

// What a motion misses the goal by costs an arc as much as a spline: the arcs that after a step of
// 0.35 m face 30 deg to either side of a far goal, and the splines that do so after 3 m.
TEST(GestaltSplineVotes, WaypointVoteIsThatOfArcsForTheSameAngle) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  const messages::Goal goal{1e7, 0.0};
  const MotionVotes arcs = ArcVoter(params).Vote(UniformGrid(kGood), {}, goal);
  params.splines.max_curvature_per_m = 0.35 * 2.0 / 3.0;
  params.splines.num_first_knots = params.splines.num_second_knots = 23;
  for (std::size_t i = 0; i < 23; ++i) {
    // The arc c_i = (i - 11) 2/11 has turned by 0.35 c_i, the spline of 0.35 c_i / 3 / m as much.
    const double c = 0.35 / 3.0 * (static_cast<double>(i) - 11.0) * 2.0 / 11.0;
    const SplineVotes votes = VotesOn(UniformGrid(kGood), goal, params, c);
    EXPECT_NEAR(votes[23 * i + i].waypoint, arcs.forward[i].waypoint, 1e-4);
  }
}

// The goal is reached anywhere in its disc, and every heading that meets the disc is as good.
TEST(GestaltSplineVotes, TheGoalIsADisc) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  const auto straight = [&params](double x, double y) {
    return VotesOn(UniformGrid(kGood), {x, y}, params)[IndexOf(kStraight, kStraight)];
  };
  EXPECT_EQ(straight(5.0, 0.2).waypoint, 255.0) << "passes 0.2 m beside the centre";
  EXPECT_EQ(straight(5.0, -0.2).waypoint, 255.0);
  EXPECT_LT(straight(5.0, 0.3).waypoint, 255.0);
  EXPECT_LT(straight(5.0, -0.3).waypoint, 255.0);
  // Ends in the disc, beside the centre and a little beyond it, or beside the disc.
  EXPECT_EQ(straight(2.0, 0.2).waypoint, 255.0);
  EXPECT_LT(straight(2.0, 0.6).waypoint, 200.0);
  params.waypoints.goal_tolerance_m = 0.1;
  EXPECT_LT(straight(5.0, 0.2).waypoint, 255.0);
  // Ends on the edge of a wide disc, 3-4-5, whose centre lies abeam at first, and then behind.
  params.waypoints.goal_tolerance_m = 5.0;
  EXPECT_EQ(straight(0.0, 4.0).waypoint, 255.0);
}

TEST(GestaltSplineVotes, FacingAwayVotesFromTheLowerPeak) {
  const SplineVotes votes = VotesOn(UniformGrid(kGood), {-5.0, 3.0});
  double highest = 0.0;
  for (const SplineVote& vote : votes) highest = std::max(highest, vote.waypoint);
  EXPECT_LE(highest, 128.0);
  EXPECT_GT(highest, 90.0);
  const SplineVote* chosen = ChooseSpline(votes, {});
  EXPECT_GT(chosen->spline.second_knot_per_m, 0.0) << "it turns to the goal's side";
}

// A single arc has no spacing: it counts as wide as all curvatures.
TEST(GestaltSplineVotes, GetAlongWithASingleArc) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  params.arcs.num_forward_arcs = 1;
  const SplineVotes one = VotesOn(UniformGrid(kGood), {5.0, 1.0}, params);
  params.arcs.num_forward_arcs = 2;
  const SplineVotes two = VotesOn(UniformGrid(kGood), {5.0, 1.0}, params);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].waypoint, two[i].waypoint);
}

// Expects that a spline is forbidden if and only if one of the places at which arcs would be
// judged, 0.35 m to 2.95 m, lies in one of its cells, and that the rover drives round the rock.
void ExpectForbiddenThrough(const GoodnessGrid& grid) {
  const SplineVotes votes = VotesOn(grid, {8.0, 0.0});
  const CurvatureLaw law(SplineLaw::kDistance, {});
  int forbidden = 0;
  for (const SplineVote& vote : votes) {
    bool meets = false;
    for (int k = 0; k < 27; ++k) {
      const math::Pose2 p = AlongSpline({}, vote.spline, 0.0, 0.35 + 0.1 * k, law);
      meets = meets || grid.At(p.x_m, p.y_m).goodness == 0;
    }
    EXPECT_EQ(vote.hazard, meets ? 0.0 : 255.0);
    forbidden += meets ? 1 : 0;
  }
  EXPECT_GT(forbidden, 30);
  EXPECT_LT(forbidden, 150);
  EXPECT_EQ(votes[IndexOf(kStraight, kStraight)].hazard, 0.0);
  const SplineVote* chosen = ChooseSpline(votes, {});
  ASSERT_NE(chosen, nullptr);
  EXPECT_EQ(chosen->hazard, 255.0) << "it drives round the rock";
}

// A rock ahead of half a metre's radius.
TEST(GestaltSplineVotes, ARockForbidsTheSplinesThroughIt) {
  ExpectForbiddenThrough(GridWithDisc(2.2, 0.03, 0.5));
}

// Of cells half as wide as long, in a window that is not square: the rock is half as wide.
TEST(GestaltSplineVotes, ARockForbidsInCellsThatAreNotSquareToo) {
  GoodnessGrid grid = GridWithDisc(2.2, 0.03, 0.5);
  grid.ystep_m *= 0.5;
  grid.y0_m *= 0.5;
  ExpectForbiddenThrough(grid);
}

TEST(GestaltSplineVotes, WallLeavesNothing) {
  const GoodnessGrid grid = GridOf([](double x, double) { return x > 0.4 ? kObstacle : kGood; });
  EXPECT_EQ(ChooseSpline(VotesOn(grid, {8.0, 0.0}), {}), nullptr);
}

// Unknown ground is just allowed, and weighs nothing beside the goal: 11 of certainty 0 is below
// min_vote_goodness, so that it is the merged vote.
TEST(GestaltSplineVotes, UnknownGroundIsTheLastResort) {
  const SplineVotes unknown = VotesOn(UniformGrid(kUnknownCell), {8.0, 0.0});
  for (const SplineVote& vote : unknown) {
    EXPECT_EQ(vote.hazard, 11.0);
    EXPECT_EQ(vote.hazard_certainty, 0.0);
    EXPECT_EQ(vote.merged, std::min(11.0, vote.waypoint));
  }
  EXPECT_NE(ChooseSpline(unknown, {}), nullptr);
  // Good ground on the right only: the rover chooses it, with the goal on the left.
  const GoodnessGrid right_side =
      GridOf([](double, double y) { return y < 0.2 ? kGood : kUnknownCell; });
  const SplineVotes votes = VotesOn(right_side, {8.0, 2.0});
  EXPECT_EQ(ChooseSpline(votes, {})->hazard, 255.0);
  EXPECT_LT(votes[IndexOf(14, 14)].hazard, 255.0);
}

// Rocks beyond the goal do not matter, nor do second knots if the goal is on this side of them.
TEST(GestaltSplineVotes, ANearGoalEndsWhatIsJudged) {
  const GoodnessGrid grid = GridOf([](double x, double) { return x > 1.2 ? kObstacle : kGood; });
  EXPECT_EQ(VotesOn(grid, {1.5, 0.0})[IndexOf(kStraight, kStraight)].hazard, 0.0);
  const SplineVotes votes = VotesOn(grid, {1.1, 0.0});
  EXPECT_EQ(votes[IndexOf(kStraight, kStraight)].hazard, 255.0);
  for (int i = 0; i < 15; ++i) {
    for (int j = 1; j < 15; ++j) {
      EXPECT_EQ(votes[IndexOf(i, j)].merged, votes[IndexOf(i, 0)].merged);
    }
  }
  // The straight spline ends on the goal.
  EXPECT_EQ(votes[IndexOf(kStraight, kStraight)].waypoint, 255.0);
  EXPECT_EQ(ChooseSpline(votes, {}), &votes[IndexOf(kStraight, kStraight)]);
}

TEST(GestaltSplineVotes, AreNumbersOnTheGoal) {
  for (const SplineVote& vote : VotesOn(UniformGrid(kGood), {0.0, 0.0})) {
    EXPECT_EQ(vote.hazard, 255.0);
    EXPECT_TRUE(std::isfinite(vote.waypoint_error_rad));
    EXPECT_GE(vote.waypoint, 0.0);
    EXPECT_LE(vote.merged, 255.0);
  }
}

// At 7 cm/s and 1.5 m from knot to knot |dc/dt| = 0.07 / 1.5 |k1 - k0|.
TEST(GestaltSplineVotes, SteeringThatIsTooFastIsInfeasible) {
  GestaltParams params;
  const double per_step = 0.07 / 1.5 / 7.0;  // of one knot to the next
  params.splines.max_curvature_rate_per_m_s = 4.5 * per_step;
  const SplineVotes votes = VotesOn(UniformGrid(kGood), {8.0, 3.0}, params, 2.0 / 7.0);
  for (int i = 0; i < 15; ++i) {
    for (int j = 0; j < 15; ++j) {
      const int first = std::abs(i - 9);  // the start is at index 9
      const int second = std::abs(j - i);
      EXPECT_EQ(votes[IndexOf(i, j)].feasible, first <= 4 && second <= 4);
    }
  }
  EXPECT_TRUE(ChooseSpline(votes, params)->feasible);
  // Half as fast a rover may steer twice as far.
  const SplineVotes slow =
      SplineVoter(params, 0.5 * kFullSpeed_m_s).Vote(UniformGrid(kGood), {}, 2.0 / 7.0, {8.0, 3.0});
  EXPECT_TRUE(slow[IndexOf(2, 8)].feasible);
  EXPECT_FALSE(votes[IndexOf(2, 8)].feasible);
  // So may one that slows down, between tight knots only.
  params.speed = {
      .full_speed_curvature_per_m = 0.2, .min_speed_share = 0.25, .slow_curvature_per_m = 0.3};
  const SplineVotes careful = VotesOn(UniformGrid(kGood), {8.0, 3.0}, params, 2.0 / 7.0);
  EXPECT_TRUE(careful[IndexOf(14, 14)].feasible);
  EXPECT_FALSE(votes[IndexOf(14, 14)].feasible);
  EXPECT_FALSE(careful[IndexOf(4, 4)].feasible) << "over the straight line at full speed";
}

// 1 / m within 1 m at 0.5 m/s: just as fast as the motors, which is feasible.
TEST(GestaltSplineVotes, SteeringAsFastAsTheMotorsIsFeasible) {
  GestaltParams params;
  params.splines.length_m = params.splines.waypoint_m = 2.0;
  params.splines.num_first_knots = params.splines.num_second_knots = 3;
  params.splines.max_curvature_rate_per_m_s = 0.5;
  const SplineVotes votes = SplineVoter(params, 0.5).Vote(UniformGrid(kGood), {}, 0.0, {8.0, 0.0});
  ASSERT_EQ(votes.size(), 9u);
  for (const SplineVote& vote : votes) {
    const double second = vote.spline.second_knot_per_m - vote.spline.first_knot_per_m;
    EXPECT_EQ(vote.feasible, std::abs(second) <= 1.0);
  }
}

TEST(GestaltSplineVotes, MirroredWorldGivesTheMirroredChoice) {
  core::RandomStream random({37, 0}, core::Purpose::kTest, 0);
  for (const SplineLaw law : {SplineLaw::kDistance, SplineLaw::kTime}) {
    GestaltParams params;
    params.splines.law = law;
    params.speed.min_speed_share = 0.5;
    int off_centre = 0;
    for (int trial = 0; trial < 40; ++trial) {
      const double x = 1.0 + 2.0 * random.Uniform();
      const double y = 2.0 * random.Uniform() - 1.0;
      const double radius = 0.2 + 0.5 * random.Uniform();
      const messages::PoseEstimate start =
          At(0.1, 0.4 * random.Uniform() - 0.2, 2.0 * random.Uniform() - 1.0);
      const double c = 1.6 * random.Uniform() - 0.8;
      const messages::Goal goal{4.0 * random.Uniform() + 0.5, 4.0 * random.Uniform() - 2.0};
      const SplineVotes votes = VotesOn(GridWithDisc(x, y, radius), goal, params, c, start);
      const SplineVotes mirrored =
          VotesOn(GridWithDisc(x, -y, radius), {goal.x_m, -goal.y_m}, params, -c,
                  At(start.x_m, -start.y_m, -start.heading_rad));
      for (int i = 0; i < 15; ++i) {
        for (int j = 0; j < 15; ++j) {
          const SplineVote& vote = votes[IndexOf(i, j)];
          const SplineVote& other = mirrored[IndexOf(14 - i, 14 - j)];
          ASSERT_EQ(vote.merged, other.merged);
          ASSERT_EQ(vote.hazard, other.hazard);
          ASSERT_EQ(vote.waypoint_error_rad, -other.waypoint_error_rad);
          ASSERT_EQ(vote.feasible, other.feasible);
        }
      }
      const SplineVote* chosen = ChooseSpline(votes, params);
      const SplineVote* other = ChooseSpline(mirrored, params);
      ASSERT_EQ(chosen == nullptr, other == nullptr);
      if (chosen == nullptr) continue;
      EXPECT_EQ(chosen->spline.first_knot_per_m, -other->spline.first_knot_per_m);
      EXPECT_EQ(chosen->spline.second_knot_per_m, -other->spline.second_knot_per_m);
      off_centre += chosen->spline.second_knot_per_m != 0.0 ? 1 : 0;
    }
    EXPECT_GT(off_centre, 10) << "the worlds are not symmetrical";
  }
}

// The rule of arcs: no further than where a path has turned that far, whatever it does beyond.
TEST(GestaltSplineVotes, AreJudgedUpToTheLargestTurn) {
  const GoodnessGrid grid =
      GridOf([](double x, double y) { return std::hypot(x, y) > 1.6 ? kObstacle : kGood; });
  GestaltParams params;
  const SplineVotes all = VotesOn(grid, {8.0, 0.0}, params, 1.0);
  // The arc of radius 1 m has turned 90 deg after 1.57 m, 1.4 m from where it began.
  params.plan.max_path_turn_rad = math::DegToRad(90.0);
  const SplineVotes short_ones = VotesOn(grid, {8.0, 0.0}, params, 1.0);
  EXPECT_EQ(all[IndexOf(14, 14)].hazard, 0.0);
  EXPECT_EQ(short_ones[IndexOf(14, 14)].hazard, 255.0);
  EXPECT_EQ(short_ones[IndexOf(kStraight, kStraight)].hazard, 0.0);
  // A straight line never turns by more than nothing.
  params.plan.max_path_turn_rad = 0.0;
  EXPECT_EQ(VotesOn(grid, {8.0, 0.0}, params)[IndexOf(kStraight, kStraight)].hazard, 0.0);
}

// Places beyond the end of a short spline follow its last knot.
TEST(GestaltSplineVotes, GoOnBeyondTheEndOfTheSpline) {
  GestaltParams params;
  params.splines.length_m = params.splines.waypoint_m = 1.0;
  const SplineVotes votes = VotesOn(GridWithDisc(0.05, 2.0, 0.3), {8.0, 0.0}, params, 1.0);
  EXPECT_EQ(votes[IndexOf(14, 14)].hazard, 0.0) << "on the circle of radius 1 m about (0, 1)";
  EXPECT_EQ(votes[IndexOf(kStraight, kStraight)].hazard, 255.0);
}

SplineVote Voted(double merged, double start, double first, double second, double error_rad = 0.0) {
  return {.spline = {start, first, second, 3.0},
          .hazard = 200.0,
          .waypoint_error_rad = error_rad,
          .merged = merged,
          .feasible = true};
}

// The place of the spline that is chosen; -1: none.
std::ptrdiff_t Chosen(const SplineVotes& votes, const GestaltParams& params = {}) {
  const SplineVote* chosen = ChooseSpline(votes, params);
  return chosen == nullptr ? -1 : chosen - votes.data();
}

TEST(GestaltSplineChoice, IsTheHighestMergedVote) {
  EXPECT_EQ(Chosen({Voted(190, 0, 0, 0), Voted(200, 0, 1, -1, 1.0), Voted(199, 0, 0, 0)}), 1);
}

TEST(GestaltSplineChoice, IsNeverInfeasible) {
  SplineVotes votes = {Voted(190, 0, 0, 0), Voted(200, 0, 1, -1)};
  votes[1].feasible = false;
  EXPECT_EQ(Chosen(votes), 0);
  votes[0].feasible = false;
  EXPECT_EQ(Chosen(votes), -1);
}

TEST(GestaltSplineChoice, IsNeverWhatIsNotSafeEnough) {
  SplineVotes votes = {Voted(190, 0, 0, 0), Voted(200, 0, 1, -1)};
  votes[1].hazard = 10.0;
  EXPECT_EQ(Chosen(votes), 0);
  votes[1].hazard = 11.0;
  EXPECT_EQ(Chosen(votes), 1) << "unknown ground is just allowed";
  GestaltParams careful;
  careful.drive.min_drive_goodness = 11.0;
  EXPECT_EQ(Chosen(votes, careful), 0);
  votes[0].hazard = 0.0;
  EXPECT_EQ(Chosen(votes, careful), -1);
  EXPECT_EQ(Chosen({}), -1);
}

TEST(GestaltSplineChoice, OfEqualVotesSteersLeast) {
  // |k1 - c0| + |k2 - k1|: 0.8, 0.6, 0.7; the waypoint errors say the opposite.
  EXPECT_EQ(Chosen({Voted(200, 0.2, -0.2, -0.6, 0.0), Voted(200, 0.2, 0.5, 0.2, 0.9),
                    Voted(200, 0.2, 0.9, 0.9, 0.1)}),
            1);
  // From a curve straight on costs more steering than to stay in the curve.
  EXPECT_EQ(Chosen({Voted(200, 0.5, 0.0, 0.0), Voted(200, 0.5, 0.5, 0.5)}), 1);
  // The second half counts too.
  EXPECT_EQ(Chosen({Voted(200, 0.5, 0.5, -0.5), Voted(200, 0.5, 0.1, 0.1)}), 1);
}

// All first knots between the start and the second knot steer the same; in binary the sums differ.
TEST(GestaltSplineChoice, OfEqualSteeringHeadsBestForTheGoal) {
  EXPECT_EQ(Chosen({Voted(200, 0.1, 1.0 / 7.0, 3.0 / 7.0, -0.4),
                    Voted(200, 0.1, 2.0 / 7.0, 3.0 / 7.0, 0.3),
                    Voted(200, 0.1, 3.0 / 7.0, 3.0 / 7.0, 0.5)}),
            1);
  EXPECT_EQ(Chosen({Voted(200, 0.1, 1.0 / 7.0, 3.0 / 7.0, -0.3 + 1e-12),
                    Voted(200, 0.1, 2.0 / 7.0, 3.0 / 7.0, 0.3 - 2e-12)}),
            0)
      << "equal, whatever rounding made of them";
  EXPECT_EQ(
      Chosen({Voted(200, 0.0, 1.0 / 7.0, 5.0 / 7.0, 0.5), Voted(200, 0.0, 0.0, 5.0 / 7.0, 0.3)}), 1)
      << "4/7 + 1/7 is less than 5/7 in binary";
}

TEST(GestaltSplineChoice, OfMirrorImagesIsTheRightOne) {
  EXPECT_EQ(Chosen({Voted(200, 0, -0.5, 0.5, 0.1), Voted(200, 0, 0.5, -0.5, -0.1)}), 0);
}

}  // namespace
}  // namespace rockyard::navigation
