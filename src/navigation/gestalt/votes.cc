#include "navigation/gestalt/votes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::navigation {

namespace {

using messages::MotionVote;
using messages::PoseEstimate;

// Peaks of the waypoint votes (Goldberg 2002, step 5).
constexpr double kPeakTowards = 255.0;
constexpr double kPeakAway = 128.0;

// Keeps quotients finite for a rover that stands on its goal.
constexpr double kMinDistance_m = 1e-6;

// A goal this near to straight behind is on the left, whatever rounding made of it.
constexpr double kBehind_rad = 1e-9;

// Returns whether driving in the direction brings the rover nearer to the goal, at first: forward
// for goals up to 90 deg off, backward for the others.
bool LeadsToGoal(const GoalDirection& goal, int direction) {
  const bool goal_is_ahead = std::abs(goal.bearing_rad) <= 0.5 * std::numbers::pi;
  return goal_is_ahead == (direction > 0);
}

}  // namespace

HazardVote VoteOnPath(const GoodnessGrid& grid, const PoseEstimate& estimate,
                      std::span<const PathPoint> points, std::span<const double> weights,
                      double min_allowed_goodness, UnknownCells unknown_cells) {
  EXPECT(!points.empty() && weights.size() >= points.size());
  const auto [sine, cosine] = math::SinCos(estimate.heading_rad);
  PathSums sums(unknown_cells);
  double sum_of_weights = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const PathPoint& p = points[k];
    // p_W = p_WR + Rz(heading) p_R by the believed pose.
    sums.Add(grid.At(estimate.x_m + cosine * p.x_m - sine * p.y_m,
                     estimate.y_m + sine * p.x_m + cosine * p.y_m),
             weights[k]);
    sum_of_weights += weights[k];
  }
  return sums.Vote(sum_of_weights, grid.unknown, min_allowed_goodness);
}

HazardVote PathSums::Vote(double sum_of_weights, const CellValue& unknown,
                          double min_allowed_goodness) const {
  // Step 4: goodness = sum w g / sum w, certainty = sum w c / sum w; one forbidden cell forbids the
  // path.
  const bool allowed = min_goodness_ > min_allowed_goodness;
  const double certainty = weighted_certainty_ / sum_of_weights;
  if (!allowed) return {0.0, certainty};
  if (!by_certainty_) return {weighted_goodness_ / sum_of_weights, certainty};
  // sum w c g / sum w c.
  const bool blank = weighted_certainty_ <= 0.0;
  return {blank ? unknown.goodness : weighted_goodness_ / weighted_certainty_, certainty};
}

GoalDirection TowardsGoal(const PoseEstimate& estimate, const messages::Goal& goal) {
  const double dx_m = goal.x_m - estimate.x_m;
  const double dy_m = goal.y_m - estimate.y_m;
  // Positive to the left of straight ahead.
  const double bearing_rad = math::WrapAngle(math::Atan2(dy_m, dx_m) - estimate.heading_rad);
  const bool behind = bearing_rad < kBehind_rad - std::numbers::pi;
  return {math::Hypot(dx_m, dy_m), behind ? std::numbers::pi : bearing_rad};
}

double WaypointPeak(const GoalDirection& goal, int direction) {
  return LeadsToGoal(goal, direction) ? kPeakTowards : kPeakAway;
}

double BestCurvature(const GoalDirection& goal, int direction, double step_m,
                     const GestaltParams& params) {
  const double limit = params.arcs.max_curvature_per_m;
  const double distance_m = std::max(goal.distance_m, kMinDistance_m);
  const bool towards = LeadsToGoal(goal, direction);
  const bool with_rear = towards && direction < 0;
  const double turn_rad =
      with_rear ? math::WrapAngle(goal.bearing_rad - std::numbers::pi) : goal.bearing_rad;
  // Tight: turned by `turn` after one step, c = turn / step. Driving backwards with the rear
  // towards the goal the turn is counted from straight behind, and a curvature c turns the rover by
  // -c s.
  const double tight = direction * turn_rad / std::min(step_m, distance_m);
  // The arc through a goal behind begins almost straight away from it: turn as for one abeam.
  const double right_angle = 0.5 * std::numbers::pi;
  const double bearing_rad =
      direction > 0 ? std::clamp(goal.bearing_rad, -right_angle, right_angle) : goal.bearing_rad;
  const double side = towards ? 1.0 : direction;
  // Broad: the circle through the origin, tangent to x, and through the goal at distance d, bearing
  // b: c = 2 sin(b) / d.
  const double broad = side * 2.0 * math::Sin(bearing_rad) / distance_m;
  const double fraction = params.waypoints.tight_curve_fraction;
  return fraction * std::clamp(tight, -limit, limit) +
         (1.0 - fraction) * std::clamp(broad, -limit, limit);
}

double WaypointVote(double peak, double index_from_best, double vote_index_variance) {
  // peak exp(-(i - best)^2 / (2 variance)).
  return peak * math::Exp(-0.5 * index_from_best * index_from_best / vote_index_variance);
}

double MergeVotes(const HazardVote& hazard, double waypoint, double waypoint_certainty,
                  double min_vote_goodness) {
  const double lower = std::min(hazard.goodness, waypoint);
  const double certainties = hazard.certainty + waypoint_certainty;
  if (lower < min_vote_goodness || certainties <= 0.0) return lower;
  // (h c_h + w c_w) / (c_h + c_w).
  return (hazard.goodness * hazard.certainty + waypoint * waypoint_certainty) / certainties;
}

double RoundedVote(double vote, bool whole_numbers) {
  return whole_numbers ? std::floor(vote + 0.5) : vote;
}

HazardVote RoundedVote(const HazardVote& vote, bool whole_numbers) {
  return {RoundedVote(vote.goodness, whole_numbers), RoundedVote(vote.certainty, whole_numbers)};
}

ArcVoter::ArcVoter(const GestaltParams& params)
    : params_(params),
      sampling_(
          SamplePaths(params.plan, std::min(params.map.grid.xstep_m, params.map.grid.ystep_m))),
      candidates_(MakeCandidates(params.arcs, params.plan, sampling_)) {}

MotionVotes ArcVoter::Vote(const GoodnessGrid& grid, const PoseEstimate& estimate,
                           const messages::Goal& goal) const {
  const GoalDirection goal_R = TowardsGoal(estimate, goal);
  MotionVotes votes;
  votes.forward = VoteOnArcs(candidates_.forward, +1, grid, estimate, goal_R);
  votes.backward = VoteOnArcs(candidates_.backward, -1, grid, estimate, goal_R);
  const std::size_t count = candidates_.forward.size();
  // A turn in place is voted on as the straight arc after it; of an even number of arcs the
  // straight one lies between two.
  const double straight = 0.5 * static_cast<double>(count - 1);
  for (const CandidateMotion& turn : candidates_.point_turns) {
    const GoalDirection after_turn{goal_R.distance_m,
                                   math::WrapAngle(goal_R.bearing_rad - turn.turn_rad)};
    const double waypoint = WaypointVoteAt(straight, count, +1, after_turn);
    votes.point_turns.push_back(VoteOn(turn, waypoint, grid, estimate, goal_R.distance_m));
  }
  return votes;
}

double ArcVoter::WaypointVoteAt(double index, std::size_t count, int direction,
                                const GoalDirection& goal) const {
  const double best_per_m = BestCurvature(goal, direction, params_.drive.step_m, params_);
  const std::size_t best = NearestArc(best_per_m, count, params_.arcs.max_curvature_per_m);
  return WaypointVote(WaypointPeak(goal, direction), index - static_cast<double>(best),
                      params_.waypoints.vote_index_variance);
}

std::vector<MotionVote> ArcVoter::VoteOnArcs(const std::vector<CandidateMotion>& arcs,
                                             int direction, const GoodnessGrid& grid,
                                             const PoseEstimate& estimate,
                                             const GoalDirection& goal) const {
  std::vector<MotionVote> votes;
  votes.reserve(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const double waypoint = WaypointVoteAt(static_cast<double>(i), arcs.size(), direction, goal);
    votes.push_back(VoteOn(arcs[i], waypoint, grid, estimate, goal.distance_m));
  }
  return votes;
}

MotionVote ArcVoter::VoteOn(const CandidateMotion& candidate, double waypoint,
                            const GoodnessGrid& grid, const PoseEstimate& estimate,
                            double goal_distance_m) const {
  // "Out to min(dist to goal, default length)" (step 4).
  const std::size_t count =
      std::min(candidate.points.size(), sampling_.CountWithin(goal_distance_m));
  const bool whole = params_.votes.whole_numbers;
  const HazardVote hazard = RoundedVote(
      VoteOnPath(grid, estimate, std::span(candidate.points).first(count), sampling_.weight,
                 params_.votes.min_allowed_goodness, params_.plan.unknown_cells),
      whole);
  MotionVote vote;
  vote.motion = candidate.motion;
  vote.turn_rad = candidate.turn_rad;
  vote.hazard = hazard.goodness;
  vote.hazard_certainty = hazard.certainty;
  vote.waypoint = RoundedVote(waypoint, whole);
  vote.merged = RoundedVote(MergeVotes(hazard, vote.waypoint, params_.waypoints.waypoint_certainty,
                                       params_.votes.min_vote_goodness),
                            whole);
  return vote;
}

namespace {

using messages::MotionVote;

// A row whose arcs compete. Rows are listed from the most preferred one on.
using Rows = std::vector<std::span<MotionVote>>;

bool BackwardArcsCompete(const MotionVotes& votes, const GestaltParams& params) {
  // Step 7 names the highest vote of all arcs; min-fwd-threshold of table 1 suggests that forward
  // ones go first.
  switch (params.drive.backward_arcs) {
    case BackwardArcs::kBelowThreshold:
      return BestVote(votes.forward) < params.votes.min_fwd_threshold;
    case BackwardArcs::kAlways:
      return true;
    case BackwardArcs::kLastResort:
      return BestVote(votes.forward) < params.votes.min_vote_goodness;
  }
  return true;
}

Rows CompetingRows(MotionVotes& votes, const GestaltParams& params) {
  Rows rows{votes.forward};
  if (BackwardArcsCompete(votes, params)) rows.push_back(votes.backward);
  return rows;
}

// A merged vote can be high on ground that must not be driven: the hazard vote has a bound of its
// own.
bool MayBeDriven(const MotionVote& vote, const GestaltParams& params) {
  return vote.hazard > params.drive.min_drive_goodness && !vote.vetoed;
}

// Returns the distance of an arc from the middle of its row, in arcs.
double FromStraight(std::size_t index, std::size_t count) {
  return std::abs(static_cast<double>(index) - 0.5 * static_cast<double>(count - 1));
}

// Returns the middle of [first, end). An even set has two; arcs run from right to left, so the
// first is the right one.
std::size_t Middle(std::span<const MotionVote> row, std::size_t first, std::size_t end) {
  const std::size_t right = (first + end - 1) / 2;
  const std::size_t left = (first + end) / 2;
  const auto worth = [&row](std::size_t i) {
    return std::make_tuple(row[i].waypoint, -FromStraight(i, row.size()));
  };
  return worth(left) > worth(right) ? left : right;
}

// A set of adjacent arcs that share the highest vote.
struct Peak {
  MotionVote* middle = nullptr;
  std::size_t length = 0;
  double from_straight = 0.0;

  bool IsBetterThan(const Peak& other) const {
    if (other.middle == nullptr) return true;
    // The paper's rule first, then what it leaves open (ChooseArc). Ties are common among whole
    // numbers, so that this order decides records.
    return std::make_tuple(length, middle->waypoint, middle->motion.direction, -from_straight) >
           std::make_tuple(other.length, other.middle->waypoint, other.middle->motion.direction,
                           -other.from_straight);
  }
};

// Returns the longest set of adjacent arcs with the highest vote; an arc that may not be driven
// ends a set.
Peak BestPeak(std::span<MotionVote> row, double highest, const GestaltParams& params) {
  const auto shares = [&](std::size_t i) {
    return i < row.size() && row[i].merged == highest && MayBeDriven(row[i], params);
  };
  Peak best;
  for (std::size_t first = 0; first < row.size(); ++first) {
    if (!shares(first)) continue;
    std::size_t end = first + 1;
    // [first, end) is a set of adjacent arcs with the highest vote.
    while (shares(end)) ++end;
    const std::size_t middle = Middle(row, first, end);
    const Peak peak{&row[middle], end - first, FromStraight(middle, row.size())};
    if (peak.IsBetterThan(best)) best = peak;
    first = end;
  }
  return best;
}

}  // namespace

MotionVote* ChooseArc(MotionVotes& votes, const GestaltParams& params) {
  const Rows rows = CompetingRows(votes, params);
  double highest = -1.0;
  for (const auto row : rows) {
    for (const MotionVote& vote : row) {
      // Step 7: the highest merged vote of the arcs that compete and may be driven.
      if (MayBeDriven(vote, params)) highest = std::max(highest, vote.merged);
    }
  }
  Peak best;
  for (const auto row : rows) {
    const Peak peak = BestPeak(row, highest, params);
    if (peak.middle != nullptr && peak.IsBetterThan(best)) best = peak;
  }
  return best.middle;
}

// Decides by the reading of the paper that the parameters choose.
bool TurnsInPlace(const MotionVote& turn, const MotionVote* arc, const GestaltParams& params) {
  switch (params.drive.point_turns) {
    case PointTurns::kNever:
      return false;
    case PointTurns::kNothingSafe:
      return arc == nullptr;
    case PointTurns::kBelowMinVote:
      return arc == nullptr || arc->merged < params.votes.min_vote_goodness;
    case PointTurns::kCandidates:
      return arc == nullptr || turn.merged > arc->merged + params.drive.point_turn_margin;
  }
  return false;
}

MotionVote* ChoosePointTurn(MotionVotes& votes, double goal_bearing_rad) {
  EXPECT(!votes.point_turns.empty());
  const int goal_side = goal_bearing_rad < 0.0 ? -1 : +1;
  const auto worth = [&](const MotionVote& turn) {
    return std::make_tuple(turn.merged, turn.motion.direction == goal_side,
                           -std::abs(turn.turn_rad));
  };
  return &*std::max_element(
      votes.point_turns.begin(), votes.point_turns.end(),
      [&](const MotionVote& a, const MotionVote& b) { return worth(a) < worth(b); });
}

MotionVote* PointTurnTo(MotionVotes& votes, int side, double amount_rad) {
  MotionVote* nearest = nullptr;
  const auto misses_by = [&](const MotionVote& turn) {
    return std::abs(side * turn.turn_rad - amount_rad);
  };
  for (MotionVote& turn : votes.point_turns) {
    if (turn.motion.direction != side) continue;
    if (nearest == nullptr || misses_by(turn) < misses_by(*nearest)) nearest = &turn;
  }
  EXPECT(nearest != nullptr);
  return nearest;
}

double BestVote(std::span<const MotionVote> row) {
  double best = 0.0;
  for (const MotionVote& vote : row) best = std::max(best, vote.merged);
  return best;
}

void MarkChoice(MotionVotes& votes, MotionVote& chosen, const GestaltParams& params) {
  Rows rows{votes.point_turns};
  const bool arc = chosen.motion.kind == messages::MotionKind::kArc;
  if (arc) rows = CompetingRows(votes, params);
  for (const auto row : rows) {
    for (MotionVote& vote : row) {
      // For the view: figure 3 of the paper underlines all candidates of the highest vote.
      vote.best = vote.merged == chosen.merged && (!arc || MayBeDriven(vote, params));
    }
  }
  chosen.chosen = true;
}

}  // namespace rockyard::navigation
