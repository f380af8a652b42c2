// The votes of GESTALT on every candidate motion, and the choice among them: how safe a motion is,
// how well it leads to the goal, and both merged (Goldberg 2002, section 4, steps 4 to 7). Votes
// run from 0 to 255. Evaluation and the drive cycle vote and choose by it; splines share its
// formulas. No state, and nothing of the drive cycle, so that other navigators can use them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "navigation/gestalt/arcs.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/goodness_grid.h"

namespace rockyard::navigation {

// How safe a path is, and how sure that is.
struct HazardVote {
  double goodness = 0.0;
  double certainty = 0.0;
};

// The sums of step 4 over the cells under a path, one after the other.
class PathSums {
 public:
  explicit PathSums(UnknownCells unknown_cells)
      : by_certainty_(unknown_cells == UnknownCells::kByCertainty) {}

  void Add(const CellValue& cell, double weight) {
    weighted_goodness_ += weight * (by_certainty_ ? cell.certainty : 1.0) * cell.goodness;
    weighted_certainty_ += weight * cell.certainty;
    min_goodness_ = std::min(min_goodness_, cell.goodness);
  }

  // Returns the vote, as VoteOnPath does, on a path of all cells that were added.
  HazardVote Vote(double sum_of_weights, const CellValue& unknown,
                  double min_allowed_goodness) const;

 private:
  bool by_certainty_;
  double weighted_goodness_ = 0.0;
  double weighted_certainty_ = 0.0;
  std::uint8_t min_goodness_ = 255;
};

// Votes by step 4, "a weighted sum, biased to consider nearby cells more strongly", over the cells
// under the first points of a path, with w the weights:
//   goodness  = sum w g / sum w, but 0 if any g <= min_allowed_goodness,
//   certainty = sum w c / sum w.
// Unknown cells count with their pair. With UnknownCells::kByCertainty goodness = sum w c g / sum w
// c, and a path without any certainty has the goodness of the pair. `estimate` is where the path
// begins. There are at least as many weights as points; cost: one look into the grid a point.
HazardVote VoteOnPath(const GoodnessGrid& grid, const messages::PoseEstimate& estimate,
                      std::span<const PathPoint> points, std::span<const double> weights,
                      double min_allowed_goodness, UnknownCells unknown_cells);

// The goal as the rover sees it.
struct GoalDirection {
  double distance_m = 0.0;
  double bearing_rad = 0.0;  // from straight ahead, positive left, in (-pi, pi]
};

GoalDirection TowardsGoal(const messages::PoseEstimate& estimate, const messages::Goal& goal);

// Returns the highest waypoint vote (step 5) of arcs driven in the direction (+1 forward, -1
// backward): 255 if the direction leads towards the goal, and 128 otherwise. Forward leads towards
// goals at bearings up to 90 deg, backward towards the others.
double WaypointPeak(const GoalDirection& goal, int direction);

// Returns the curvature of the arc that "best points the rover toward the goal" (step 5), 1/m, at
// most max_curvature:
//   c = f c_tight + (1 - f) c_broad,  f = tight_curve_fraction.
// Tight faces the goal after one step, c_tight = direction * turn / min(step, distance), where
// `turn` brings the front to the goal, or the rear when driving backward towards a goal behind.
// Broad is the one arc through the goal, c_broad = 2 sin(bearing) / distance. Two cases have no
// such arc. Driving forward away from a goal behind, the bearing counts as 90 deg. Driving backward
// away from a goal ahead, the arc's mirror image is meant, which turns the front to the goal. A
// goal exactly behind, to 1e-9 rad, counts as on the left. The paper names the two ends only
// ("Broad (0) v. Tight (1)").
double BestCurvature(const GoalDirection& goal, int direction, double step_m,
                     const GestaltParams& params);

// Returns the waypoint vote of an arc (step 5), a Gaussian around the best arc: peak exp(-(index -
// best)^2 / (2 vote_index_variance)).
double WaypointVote(double peak, double index_from_best, double vote_index_variance);

// Returns the merged vote (step 6): the lower vote if either is below min_vote_goodness, otherwise
// the mean weighted by the certainties. If both certainties are 0 it is the lower vote.
double MergeVotes(const HazardVote& hazard, double waypoint, double waypoint_certainty,
                  double min_vote_goodness);

// Returns the vote, rounded half up where votes are whole_numbers.
double RoundedVote(double vote, bool whole_numbers);
HazardVote RoundedVote(const HazardVote& vote, bool whole_numbers);

// The votes in the rows of CandidateMotions.
struct MotionVotes {
  std::vector<messages::MotionVote> forward;
  std::vector<messages::MotionVote> backward;
  std::vector<messages::MotionVote> point_turns;
};

// Holds the candidates, and votes on them. The waypoint vote of a turn in place is that of the
// straight arc after the turn. Records depend on the rounding: where votes are whole_numbers each
// is rounded, half up, as soon as it is formed.
class ArcVoter {
 public:
  explicit ArcVoter(const GestaltParams& params);

  // Paths are judged up to min(distance to the goal, plan_max_dist). Cost: 46 arcs at 2.7 m, two
  // points a cell.
  MotionVotes Vote(const GoodnessGrid& grid, const messages::PoseEstimate& estimate,
                   const messages::Goal& goal) const;

  const PathSampling& sampling() const { return sampling_; }

 private:
  // Returns the waypoint vote on the arc at `index`, which may lie between two arcs, among `count`
  // driven in the direction.
  double WaypointVoteAt(double index, std::size_t count, int direction,
                        const GoalDirection& goal) const;
  std::vector<messages::MotionVote> VoteOnArcs(const std::vector<CandidateMotion>& arcs,
                                               int direction, const GoodnessGrid& grid,
                                               const messages::PoseEstimate& estimate,
                                               const GoalDirection& goal) const;
  messages::MotionVote VoteOn(const CandidateMotion& candidate, double waypoint,
                              const GoodnessGrid& grid, const messages::PoseEstimate& estimate,
                              double goal_distance_m) const;

  GestaltParams params_;
  PathSampling sampling_;
  CandidateMotions candidates_;
};

// Returns, of the arcs that may be driven, the one with the highest merged vote; "in case of
// multiple peaks, the middle arc of the longest adjacent set". Null if none may be driven.
//
// An arc may be driven if its hazard vote is above min_drive_goodness and it is not vetoed, and
// backward arcs only as BackwardArcs says. The paper leaves ties open, and records depend on them:
// of the two middles of an even set, and of equally long sets, the one with the higher waypoint
// vote is taken, then forward before backward, then the one nearer to straight, then the right one.
// Mirrored votes so give the mirrored choice unless they are their own mirror image.
//
// The pointer is into `votes`. Cost: linear in the number of arcs.
messages::MotionVote* ChooseArc(MotionVotes& votes, const GestaltParams& params);

// Returns whether `turn` is to be made instead of driving `arc` (null: none), as PointTurns says.
bool TurnsInPlace(const messages::MotionVote& turn, const messages::MotionVote* arc,
                  const GestaltParams& params);

// Returns the best of the turns in place; of equals one towards the goal (left for a goal straight
// ahead or behind), and of these the smallest.
messages::MotionVote* ChoosePointTurn(MotionVotes& votes, double goal_bearing_rad);

// Returns the turn in place to that side (+1 left, -1 right) whose angle is nearest to
// `amount_rad`.
messages::MotionVote* PointTurnTo(MotionVotes& votes, int side, double amount_rad);

// Returns the highest merged vote of a row; 0 for an empty one.
double BestVote(std::span<const messages::MotionVote> row);

// Sets the marks of the view: `chosen` on the chosen motion, and `best` on it and on all motions of
// its kind that could have been chosen and share its merged vote.
void MarkChoice(MotionVotes& votes, messages::MotionVote& chosen, const GestaltParams& params);

}  // namespace rockyard::navigation
