// Which spline is chosen, from votes written by hand.
#include <gtest/gtest.h>

#include "navigation/gestalt/splines.h"

namespace rockyard::navigation {
namespace {

using messages::SplineVote;

SplineVote Voted(double merged, double start, double first, double second, double error_rad = 0.0) {
  SplineVote vote;
  vote.spline = {start, first, second, 3.0};
  vote.hazard = 200.0;
  vote.merged = merged;
  vote.waypoint_error_rad = error_rad;
  vote.feasible = true;
  return vote;
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
