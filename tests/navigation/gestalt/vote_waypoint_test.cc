// Waypoint votes and merging (Goldberg 2002, section 4, steps 5 and 6).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "grids.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kPi = std::numbers::pi;

GestaltParams Exact(double tight_curve_fraction = 1.0) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  params.waypoints.tight_curve_fraction = tight_curve_fraction;
  return params;
}

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
