// Which motion is chosen (Goldberg 2002, section 4, step 7), from votes written by hand; and point
// turns of several angles: which there are, which is chosen, and how far they turn.

#include <gtest/gtest.h>

#include <string>

#include "drive.h"
#include "navigation/gestalt/arcs.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

using messages::MotionKind;
using messages::MotionVote;

// Arcs from right to left with these merged votes; hazard votes follow them. Waypoint votes fall
// from arc `best` on.
std::vector<MotionVote> Row(const std::vector<double>& merged, int direction, int best) {
  std::vector<MotionVote> row;
  for (std::size_t i = 0; i < merged.size(); ++i) {
    MotionVote vote{.motion = {MotionKind::kArc, ArcCurvature(i, merged.size(), 2.0), direction},
                    .hazard = merged[i],
                    .waypoint = 255.0 - 10.0 * std::abs(static_cast<int>(i) - best),
                    .merged = merged[i]};
    row.push_back(vote);
  }
  return row;
}

MotionVotes Votes(const std::vector<double>& forward, const std::vector<double>& backward = {},
                  int best = 3) {
  MotionVotes votes;
  votes.forward = Row(forward, +1, best);
  votes.backward = Row(backward, -1, best);
  for (const int direction : {-1, +1}) {
    MotionVote turn;
    turn.motion = {MotionKind::kTurnInPlace, 0.0, direction};
    turn.merged = 11.0;
    votes.point_turns.push_back(turn);
  }
  return votes;
}

// "f3": forward arc 3, "b0": backward arc 0, "-": none.
std::string Chosen(MotionVotes votes, const GestaltParams& params = {}) {
  const MotionVote* arc = ChooseArc(votes, params);
  if (arc == nullptr) return "-";
  for (std::size_t i = 0; i < votes.forward.size(); ++i) {
    if (arc == &votes.forward[i]) return {'f', static_cast<char>('0' + i)};
  }
  for (std::size_t i = 0; i < votes.backward.size(); ++i) {
    if (arc == &votes.backward[i]) return {'b', static_cast<char>('0' + i)};
  }
  return "?";
}

TEST(GestaltChoice, IsTheMiddleOfTheLongestSetOfTheHighestVote) {
  struct {
    std::vector<double> merged;
    int best;
    std::string chosen;
    const char* what;
  } kCases[] = {
      {{190, 200, 210, 205, 195, 190, 185}, 3, "f2", "the highest vote"},
      {{190, 210, 210, 210, 195, 190, 185}, 3, "f2", "the middle of an odd set"},
      {{190, 210, 210, 210, 210, 190, 185}, 6, "f3", "of two middles that towards the waypoint"},
      {{190, 210, 210, 210, 210, 190, 185}, 0, "f2", "of two middles that towards the waypoint"},
      {{210, 210, 210, 190, 210, 210, 190}, 5, "f1", "the longest, far from the waypoint too"},
      {{210, 190, 210, 190, 210, 210, 210}, 0, "f5", "the longest, far from the waypoint too"},
      {{210, 210, 210, 190, 210, 210, 210}, 4, "f5", "of equally long ones the waypoint's"},
      {{210, 210, 210, 190, 210, 210, 210}, 2, "f1", "of equally long ones the waypoint's"},
      {{210, 210, 210, 190, 210, 210, 210}, 3, "f1", "the right one of two alike"},
      {{190, 190, 190, 190, 190, 210, 210}, 6, "f6", "a set that touches the end"},
      {{210, 210, 210, 210, 210, 210, 210}, 3, "f3", "a set that touches both"},
      {{0, 0, 0, 0, 0, 0, 0}, 3, "-", "nothing is safe"},
      {{0, 0, 0, 10, 0, 0, 0}, 3, "-", "nothing is safe enough"},
      {{0, 0, 0, 11, 0, 0, 0}, 3, "f3", "unknown ground is just allowed"}};
  for (const auto& row : kCases) {
    EXPECT_EQ(Chosen(Votes(row.merged, {}, row.best)), row.chosen) << row.what;
  }
}

TEST(GestaltChoice, BackwardArcsCompeteAsNamed) {
  const std::vector<double> backward = {150, 150, 150, 200, 150, 150, 150};
  EXPECT_EQ(Chosen(Votes({100, 100, 100, 180, 100, 100, 100}, backward)), "f3") << "180: not below";
  EXPECT_EQ(Chosen(Votes({100, 100, 100, 179, 100, 100, 100}, backward)), "b3");
  GestaltParams always;
  always.drive.backward_arcs = BackwardArcs::kAlways;
  EXPECT_EQ(Chosen(Votes({100, 100, 100, 180, 100, 100, 100}, backward), always), "b3");
  GestaltParams last_resort;
  last_resort.drive.backward_arcs = BackwardArcs::kLastResort;
  EXPECT_EQ(Chosen(Votes({0, 0, 0, 26, 0, 0, 0}, backward), last_resort), "f3") << "26: not below";
  EXPECT_EQ(Chosen(Votes({0, 0, 0, 25, 0, 0, 0}, backward), last_resort), "b3");
}

TEST(GestaltChoice, ForwardBeforeBackwardAmongEquals) {
  EXPECT_EQ(Chosen(Votes({0, 0, 0, 100, 0, 0, 0}, {0, 0, 0, 100, 0, 0, 0})), "f3");
}

TEST(GestaltChoice, WhatIsNotSafeEnoughIsNeverDriven) {
  GestaltParams careful;
  careful.drive.min_drive_goodness = 11.0;
  EXPECT_EQ(Chosen(Votes({0, 0, 0, 11, 0, 0, 0}), careful), "-");
  // A forbidden arc between two that share its vote parts their set.
  MotionVotes votes = Votes({0, 200, 200, 200, 200, 0, 0}, {}, 6);
  votes.forward[3].hazard = 5.0;
  EXPECT_EQ(Chosen(votes), "f2") << "unparted it would be f3";
}

TEST(GestaltChoice, MirroredVotesGiveTheMirroredArc) {
  const std::vector<std::vector<double>> rows = {{190, 200, 210, 205, 195, 190, 185},
                                                 {210, 210, 0, 0, 210, 0, 0},
                                                 {0, 210, 210, 210, 210, 0, 0},
                                                 {210, 210, 210, 0, 210, 210, 0},
                                                 {0, 0, 0, 11, 11, 11, 11}};
  for (const auto& row : rows) {
    for (const int best : {0, 2, 5}) {
      const std::string chosen = Chosen(Votes(row, {}, best));
      const std::string mirrored =
          Chosen(Votes(std::vector<double>(row.rbegin(), row.rend()), {}, 6 - best));
      EXPECT_EQ(chosen[1] - '0', 6 - (mirrored[1] - '0')) << best;
    }
  }
}

// Of the two the left turn is the one that would be made.
bool Turns(const MotionVotes& votes, PointTurns when) {
  GestaltParams params;
  params.drive.point_turns = when;
  MotionVotes copy = votes;
  return TurnsInPlace(copy.point_turns.back(), ChooseArc(copy, params), params);
}

TEST(GestaltChoice, PointTurnsAsNamed) {
  const MotionVotes blocked = Votes({0, 0, 0, 0, 0, 0, 0});
  const MotionVotes unknown = Votes({0, 0, 0, 25, 0, 0, 0});
  MotionVotes known = Votes({0, 0, 0, 26, 0, 0, 0});
  EXPECT_FALSE(Turns(blocked, PointTurns::kNever));
  EXPECT_TRUE(Turns(blocked, PointTurns::kNothingSafe));
  EXPECT_FALSE(Turns(unknown, PointTurns::kNothingSafe));
  EXPECT_TRUE(Turns(blocked, PointTurns::kBelowMinVote));
  EXPECT_TRUE(Turns(unknown, PointTurns::kBelowMinVote));
  EXPECT_FALSE(Turns(known, PointTurns::kBelowMinVote));
  EXPECT_FALSE(Turns(known, PointTurns::kCandidates));
  known.point_turns[0].merged = 27.0;
  EXPECT_FALSE(Turns(known, PointTurns::kCandidates)) << "the other turn";
  known.point_turns[1].merged = 27.0;
  EXPECT_TRUE(Turns(known, PointTurns::kCandidates));
}

TEST(GestaltChoice, ATurnHasToBeBetterByItsMargin) {
  GestaltParams params;
  params.drive.point_turns = PointTurns::kCandidates;
  params.drive.point_turn_margin = 20.0;
  MotionVotes votes = Votes({0, 0, 0, 100, 0, 0, 0});
  votes.point_turns.back().merged = 120.0;
  EXPECT_FALSE(TurnsInPlace(votes.point_turns.back(), ChooseArc(votes, params), params));
  votes.point_turns.back().merged = 121.0;
  EXPECT_TRUE(TurnsInPlace(votes.point_turns.back(), ChooseArc(votes, params), params));
  EXPECT_TRUE(TurnsInPlace(votes.point_turns.back(), nullptr, params))
      << "no arc to be better than";
}

TEST(GestaltChoice, BetterPointTurnElseTowardsTheGoal) {
  MotionVotes votes = Votes({0});
  EXPECT_EQ(ChoosePointTurn(votes, -0.1)->motion.direction, -1);
  EXPECT_EQ(ChoosePointTurn(votes, 0.1)->motion.direction, +1);
  EXPECT_EQ(ChoosePointTurn(votes, 0.0)->motion.direction, +1);
  votes.point_turns[0].merged = 12.0;
  EXPECT_EQ(ChoosePointTurn(votes, 0.1)->motion.direction, -1);
}

TEST(GestaltChoice, VetoedArcsAreNotDriven) {
  MotionVotes votes = Votes({100, 170, 210, 180, 170, 0, 0}, {0, 0, 0, 250, 0, 0, 0});
  EXPECT_EQ(Chosen(votes), "f2");
  votes.forward[2].vetoed = true;
  EXPECT_EQ(Chosen(votes), "f3");
}

TEST(GestaltChoice, MarksWhatSharesTheVoteAndWhatIsChosen) {
  MotionVotes votes = Votes({100, 170, 170, 100, 170, 0, 0}, {0, 0, 0, 170, 0, 0, 0});
  MotionVote* arc = ChooseArc(votes, {});
  MarkChoice(votes, *arc, {});
  const std::vector<bool> best = {false, true, true, false, true, false, false};
  for (std::size_t i = 0; i < best.size(); ++i) {
    EXPECT_EQ(votes.forward[i].best, best[i]) << i;
    EXPECT_EQ(votes.forward[i].chosen, i == 2) << i;
    EXPECT_EQ(votes.backward[i].best, i == 3) << i;
    EXPECT_FALSE(votes.backward[i].chosen);
  }
  EXPECT_FALSE(votes.point_turns[0].best);
}

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

MotionVotes TurnVotes(const std::vector<double>& merged) {
  MotionVotes votes;
  const std::vector<double> degrees{-120, -60, 60, 120};
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    MotionVote turn{.motion = {messages::MotionKind::kTurnInPlace, 0.0, degrees[i] < 0.0 ? -1 : +1},
                    .turn_rad = math::DegToRad(degrees[i]),
                    .merged = merged[i]};
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

GestaltSetup GoalBehind(double behind_deg) {
  GestaltSetup setup{.params = SixTurns()};
  setup.params.votes.min_fwd_threshold = 256.0;  // looks behind at every step
  setup.range.half_angle_rad = math::DegToRad(90.0);
  setup.rover = TrueRover();
  setup.goal = {4.0 * std::cos(math::DegToRad(behind_deg)),
                4.0 * std::sin(math::DegToRad(behind_deg))};
  return setup;
}

// The goal lies behind, and behind is clear: the rover turns round to it and drives there.
TEST(GestaltPointTurns, TurnsByTheAngleThatWasChosenAsTheGyroHasIt) {
  for (const double behind_deg : {120.0, 150.0, 180.0}) {
    const GestaltSetup setup = GoalBehind(behind_deg);
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

// A turn that ran out of time faces another way than the drive that was voted on.
TEST(GestaltPointTurns, ALookFollowsATurnThatRanOutOfTime) {
  GestaltSetup setup = GoalBehind(120.0);
  setup.params.drive.step_time_out_s = 1.0;
  GestaltDrive drive(setup);
  ASSERT_TRUE(drive.StepUntil(&GestaltTick::turns));
  ASSERT_TRUE(drive.StepUntil([](const GestaltTick& tick) { return !tick.turns(); }));
  EXPECT_TRUE(drive.log().back().decision.looks());
}

}  // namespace
}  // namespace rockyard::navigation
