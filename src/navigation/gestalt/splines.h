// The splines among which a rover that steers while it drives chooses, and their votes (Howard
// 2012, sections 2 and 3): the arcs of GESTALT replaced by clothoids that begin at the curvature
// that the rover steers, "the same traversability analysis [...] used". No state, and nothing of
// the drive cycle.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "navigation/gestalt/arcs.h"
#include "navigation/gestalt/clothoid.h"
#include "navigation/gestalt/curvature_law.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/spline_curves.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {

// By the first knot from right to left, then by the second one.
using SplineVotes = std::vector<messages::SplineVote>;

// Votes on the splines of all knots. Hazard votes, merged votes and their rounding are those of
// arcs (VoteOnPath, MergeVotes), out to min(distance to the goal, plan_max_dist) at the places of
// PathSampling, and no further than where a spline has turned max_path_turn; beyond its end it goes
// on at the curvature of its last knot. The waypoint vote is what arcs are given by their index,
// the curvature by which they differ from the best one in spacings of the arcs: a spline whose
// heading after w = min(waypoint_m, distance to the goal) differs by e from the direction from
// there to the goal would have had to be curved by e / w more,
//   index = e / (w spacing),  vote = peak exp(-index^2 / (2 vote_index_variance)),
// with the peak of forward arcs. On the goal e is 0.
//
// A spline is feasible if its curvature never changes faster than max_curvature_rate at the speed
// of the speed law.
class SplineVoter {
 public:
  // `full_speed_m_s` is that of the rover's centre on a straight line.
  SplineVoter(const GestaltParams& params, double full_speed_m_s);

  // Returns the votes on all splines that begin at `start` with that curvature. Second halves are
  // the same whatever the start: they were made with the voter, and are moved to where the first
  // ones end. Cost: a look into the grid for each place, of which splines with one first knot share
  // those of the first half.
  SplineVotes Vote(const GoodnessGrid& grid, const messages::PoseEstimate& start,
                   double curvature_per_m, const messages::Goal& goal) const;

  const CurvatureLaw& law() const { return law_; }
  const PathSampling& sampling() const { return sampling_; }

 private:
  // What a spline does after its first knot, in the frame that it has there.
  struct SecondHalf {
    Spline spline;  // of any start
    std::vector<ClothoidPoint> points;
    double largest_turn_rad = 0.0;  // |heading| of any of the points
    ClothoidPoint at_waypoint;      // after waypoint_m, if that is beyond the first knot
    bool feasible = false;
  };
  struct FirstHalf;
  struct Question;

  SecondHalf MakeSecondHalf(double first_knot_per_m, double second_knot_per_m) const;
  FirstHalf MakeFirstHalf(const Spline& spline, const Question& question) const;
  HazardVote JudgeWhole(const FirstHalf& first, const SecondHalf& second,
                        const Question& question) const;
  ClothoidPoint AtWaypoint(const FirstHalf& first, const SecondHalf& second,
                           const Question& question) const;
  messages::SplineVote VoteOn(const FirstHalf& first, const SecondHalf& second,
                              const Question& question) const;

  GestaltParams params_;
  double full_speed_m_s_;
  CurvatureLaw law_;
  PathSampling sampling_;
  std::size_t first_points_ = 0;         // of the sampling, up to the first knot
  std::vector<double> sum_of_weights_;   // of the first k points
  std::vector<SecondHalf> second_halves_;
};

// Returns the spline with the highest merged vote of those that are feasible and whose hazard vote
// is above min_drive_goodness; null if there is none. Of equal votes, which whole numbers often
// are, the one with the least steering |k1 - c0| + |k2 - k1|, then the one whose waypoint error is
// least, both to 1e-9, then the right one: the one with the first knot further to the right, and of
// one first knot with the second. Mirrored votes so give the mirrored choice unless two splines are
// each other's mirror image in all of that.
//
// The pointer is into `votes`. Cost: linear in their number.
const messages::SplineVote* ChooseSpline(std::span<const messages::SplineVote> votes,
                                         const GestaltParams& params);

}  // namespace rockyard::navigation
