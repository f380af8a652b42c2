// Point turns of several angles: which there are, which is chosen, and how far they turn.
#include <gtest/gtest.h>

#include "drive.h"
#include "grids.h"
#include "navigation/gestalt/arcs.h"
#include "navigation/gestalt/choice.h"

namespace rockyard::navigation {
namespace {

using messages::MotionVote;

GestaltParams SixTurns() {
  GestaltParams params;
  params.arcs.num_point_turns = 6;
  params.drive.point_turns = PointTurns::kCandidates;
  params.drive.backward_arcs = BackwardArcs::kLastResort;
  return params;
}

TEST(GestaltPointTurns, AreSpacedEvenlyUpToHalfATurnFromRightToLeft) {
  const GestaltParams params = SixTurns();
  const CandidateMotions motions =
      MakeCandidates(params.arcs, params.plan, SamplePaths(params.plan, 0.2));
  ASSERT_EQ(motions.point_turns.size(), 12U);
  const std::vector<double> degrees{-180, -150, -120, -90, -60, -30, 30, 60, 90, 120, 150, 180};
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const CandidateMotion& turn = motions.point_turns[i];
    EXPECT_NEAR(math::RadToDeg(turn.turn_rad), degrees[i], 1e-9);
    EXPECT_EQ(turn.motion.direction, degrees[i] < 0.0 ? -1 : 1);
    // The straight drive after the turn, judged as far as every other.
    EXPECT_NEAR(std::atan2(turn.points.back().y_m, turn.points.back().x_m),
                math::WrapAngle(turn.turn_rad), 1e-9);
  }
}

TEST(GestaltPointTurns, NoneNamedIsTheAmountOfTableOneToEitherSide) {
  const GestaltParams params;
  const CandidateMotions motions =
      MakeCandidates(params.arcs, params.plan, SamplePaths(params.plan, 0.2));
  ASSERT_EQ(motions.point_turns.size(), 2U);
  EXPECT_EQ(motions.point_turns[0].turn_rad, -params.arcs.point_turn_amount_rad);
  EXPECT_EQ(motions.point_turns[1].turn_rad, params.arcs.point_turn_amount_rad);
}

MotionVotes TurnVotes(const std::vector<double>& merged) {
  MotionVotes votes;
  const std::vector<double> degrees{-120, -60, 60, 120};
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    MotionVote turn;
    turn.motion = {messages::MotionKind::kTurnInPlace, 0.0, degrees[i] < 0.0 ? -1 : +1};
    turn.turn_rad = math::DegToRad(degrees[i]);
    turn.merged = merged[i];
    votes.point_turns.push_back(turn);
  }
  return votes;
}

double Chosen_deg(const std::vector<double>& merged, double bearing_rad) {
  MotionVotes votes = TurnVotes(merged);
  return math::RadToDeg(ChoosePointTurn(votes, bearing_rad)->turn_rad);
}

TEST(GestaltPointTurns, TheBestThenTheGoalsSideThenTheSmallest) {
  EXPECT_NEAR(Chosen_deg({9, 9, 9, 10}, -1.0), 120.0, 1e-9);
  EXPECT_NEAR(Chosen_deg({9, 9, 9, 9}, -1.0), -60.0, 1e-9);
  EXPECT_NEAR(Chosen_deg({9, 9, 9, 9}, 0.0), 60.0, 1e-9);
  EXPECT_NEAR(Chosen_deg({9, 8, 8, 8}, 1.0), -120.0, 1e-9);
}

TEST(GestaltPointTurns, ASearchTakesTheAngleNearestToItsAmount) {
  MotionVotes votes = TurnVotes({0, 0, 0, 0});
  EXPECT_NEAR(math::RadToDeg(PointTurnTo(votes, -1, math::DegToRad(100.0))->turn_rad), -120, 1e-9);
  EXPECT_NEAR(math::RadToDeg(PointTurnTo(votes, +1, math::DegToRad(80.0))->turn_rad), 60, 1e-9);
}

// The goal lies behind, and behind is clear: the rover turns round to it and drives there.
TEST(GestaltPointTurns, TurnsByTheAngleThatWasChosenAsTheGyroHasIt) {
  for (const double behind_deg : {120.0, 150.0, 180.0}) {
    GestaltSetup setup;
    setup.params = SixTurns();
    setup.params.votes.min_fwd_threshold = 256.0;  // looks behind at every step
    setup.range.half_angle_rad = math::DegToRad(90.0);
    setup.rover = TrueRover();
    setup.goal = {4.0 * std::cos(math::DegToRad(behind_deg)),
                  4.0 * std::sin(math::DegToRad(behind_deg))};
    GestaltDrive drive(setup);
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& tick) { return tick.moves(); }));
    ASSERT_TRUE(drive.log().back().turns());
    ASSERT_TRUE(drive.StepUntil([](const GestaltTick& tick) { return tick.decision.looks(); }));
    const double turned_rad = drive.rover().X_WR().heading_rad;
    EXPECT_NEAR(turned_rad, math::DegToRad(behind_deg), setup.rover.tick_turn_rad() + 1e-9);
    EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
    EXPECT_LT(drive.rover().estimate().distance_m, 4.2) << "straight there";
  }
}

}  // namespace
}  // namespace rockyard::navigation
