// The splines among which a rover that steers while it drives chooses (csad), and their votes
// (Howard 2012, sections 2 and 3): the arcs of GESTALT replaced by clothoids that begin at the
// curvature that the rover steers, "the same traversability analysis [...] used". Evaluation votes
// and chooses by it. No state, and nothing of the drive cycle.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "navigation/gestalt/arcs.h"
#include "navigation/gestalt/curvature_law.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/goodness_grid.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {

// Votes in the order of the first knot from right to left, then of the second. Must stay: ties go
// to the first (ChooseSpline).
using SplineVotes = std::vector<messages::SplineVote>;

// Votes on the splines of all knots. Hazard votes, merged votes and their rounding are those of
// arcs (VoteOnPath, MergeVotes), out to min(distance to the goal, plan_max_dist) at the places of
// PathSampling, and no further than where a spline has turned max_path_turn; beyond its end it goes
// on at the curvature of its last knot.
//
// The waypoint vote falls with the angle e by which a spline misses the goal, as it does for arcs.
// The best arc faces the goal after one step (c_tight of BestCurvature). An arc that would still
// have to turn by e after that step has
//   index = e / (step spacing),  vote = peak exp(-index^2 / (2 vote_index_variance))
// with the index counted from the best arc. A spline has the same vote for its e, with step_m and
// the peak of forward arcs. Its e is asked after min(waypoint_m, distance to the goal). The goal is
// a disc of goal_tolerance, since the bearing of the centre can be any for a rover that is about to
// reach it:
//   e = max(0, |angle to the centre| - asin(tolerance / distance)), 0 within the disc.
//
// A spline is feasible if its curvature never changes faster than max_curvature_rate at the speed
// of the speed law.
class SplineVoter {
 public:
  // `full_speed_m_s` is that of the rover's centre on a straight line.
  SplineVoter(const GestaltParams& params, double full_speed_m_s);

  // Returns the votes on all splines that begin at `start` with that curvature. Second halves of
  // splines are the same whatever the start: they were made with the voter, and are moved to where
  // the first halves end. Cost: a look into the grid for each place; splines with one first knot
  // share the places of the first half.
  SplineVotes Vote(const GoodnessGrid& grid, const messages::PoseEstimate& start,
                   double curvature_per_m, const messages::Goal& goal) const;

 private:
  // What a spline does after its first knot, in the frame K that it has there.
  struct SecondHalf {
    Spline spline;                  // whatever its start
    double largest_turn_rad = 0.0;  // |heading| of any of its points
    math::Pose2 at_waypoint;        // after waypoint_m, if that is not before the first knot
    bool feasible = false;
  };
  // Points of all second halves, [spline][k]: those of the sampling from first_points_ on.
  struct Points {
    std::vector<double> x_m;
    std::vector<double> y_m;
    std::vector<double> heading_rad;
  };
  struct Frame;
  struct Question;
  struct FirstHalf;
  struct Cells;

  void AddSecondHalf(double first_knot_per_m, double second_knot_per_m);
  FirstHalf MakeFirstHalf(const Spline& spline, const Question& question) const;
  // Finds the cells of the points of the splines from `first_spline` on, as many as there are
  // second knots.
  void FindCells(const Frame& knot, std::size_t first_spline, const GoodnessGrid& grid,
                 Cells& cells) const;
  // Returns how many points of a spline are judged.
  std::size_t CountJudged(const FirstHalf& first, std::size_t spline,
                          const Question& question) const;
  HazardVote JudgeWhole(const FirstHalf& first, std::size_t spline, const Cells& cells,
                        const Question& question) const;
  math::Pose2 AtWaypoint(std::size_t spline, double waypoint_m) const;
  void VoteOn(const FirstHalf& first, std::size_t spline, const Cells& cells,
              const Question& question, messages::SplineVote& vote) const;
  // Returns distance and bearing of the goal from where the waypoint vote is asked.
  GoalDirection FromWaypoint(const FirstHalf& first, std::size_t spline,
                             const Question& question) const;
  bool IsFeasible(double from_per_m, double to_per_m) const;  // from one knot to the next
  bool TurnedEnough(double turned_rad) const;                 // to be judged no further
  double Knot_m() const;                                      // of the first knot

  GestaltParams params_;
  double full_speed_m_s_;
  CurvatureLaw law_;
  PathSampling sampling_;
  std::size_t first_points_ = 0;        // of the sampling, before the first knot
  std::size_t second_points_ = 0;       // the others
  std::vector<double> sum_of_weights_;  // of the first k points
  std::vector<SecondHalf> second_halves_;
  Points points_K_;
};

// Returns the spline with the highest merged vote of those that are feasible and whose hazard vote
// is above min_drive_goodness; null if there is none. Votes in whole numbers are often equal.
// Records depend on the choice among equals: the one with the least steering |k1 - c0| + |k2 - k1|,
// then the one that heads best for the goal's centre where the waypoint vote is asked, both to
// 1e-9, then the right one: that with the first knot further to the right, and of one first knot
// that with the second. Mirrored votes so give the mirrored choice unless two splines are each
// other's mirror image in all of that.
//
// The pointer is into `votes`. Cost: linear in their number.
const messages::SplineVote* ChooseSpline(std::span<const messages::SplineVote> votes,
                                         const GestaltParams& params);

}  // namespace rockyard::navigation
