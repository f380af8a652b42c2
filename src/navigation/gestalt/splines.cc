#include "navigation/gestalt/splines.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/check.h"
#include "math/angles.h"

namespace rockyard::navigation {
namespace {

using messages::PoseEstimate;
using messages::SplineVote;

// A rover this near to its goal stands on it, so that no direction leads there.
constexpr double kOnGoal_m = 1e-6;

// Steering and errors closer than this are equal, whatever rounding made of them.
constexpr double kEqual = 1e-9;

// Spacing of the arcs in curvature, 1/m; a single arc is as wide as all of them.
double ArcSpacing(const GestaltArcParams& arcs) {
  const std::int64_t gaps = std::max<std::int64_t>(1, arcs.num_forward_arcs - 1);
  return 2.0 * arcs.max_curvature_per_m / static_cast<double>(gaps);
}

ClothoidPoint AsPoint(const PoseEstimate& pose) { return {pose.x_m, pose.y_m, pose.heading_rad}; }

// Changes of curvature along a spline, 1/m.
double Steering(const Spline& spline) {
  return std::abs(spline.first_knot_per_m - spline.start_per_m) +
         std::abs(spline.second_knot_per_m - spline.first_knot_per_m);
}

// The angle by which a heading misses the goal, a disk.
double MissedBy(const GoalDirection& goal, double tolerance_m) {
  if (goal.distance_m <= tolerance_m) return 0.0;
  const double beyond_rad = std::abs(goal.bearing_rad) - std::asin(tolerance_m / goal.distance_m);
  return std::copysign(std::max(0.0, beyond_rad), goal.bearing_rad);
}

}  // namespace

// What is asked of all splines of one Vote.
struct SplineVoter::Question {
  const GoodnessGrid& grid;
  ClothoidPoint start_W;
  messages::Goal goal_W;
  std::size_t count = 0;     // points that are judged
  double waypoint_m = 0.0;   // where the waypoint vote is asked
  double peak = 0.0;         // of the waypoint votes
  double index_per_rad = 0.0;
};

// What the splines of one first knot share, in W.
struct SplineVoter::FirstHalf {
  explicit FirstHalf(UnknownCells unknown_cells) : sums(unknown_cells) {}

  Spline spline;  // of any second knot
  PathSums sums;
  std::size_t count = 0;  // points in the sums
  bool turned_enough = false;
  ClothoidPoint end_W;
  ClothoidPoint at_waypoint_W;  // if that is not beyond it
  bool feasible = false;
};

SplineVoter::SplineVoter(const GestaltParams& params, double full_speed_m_s)
    : params_(params),
      full_speed_m_s_(full_speed_m_s),
      law_(params.splines.law, params.speed),
      sampling_(
          SamplePaths(params.plan, std::min(params.map.grid.xstep_m, params.map.grid.ystep_m))) {
  EXPECT(full_speed_m_s > 0.0);
  const GestaltSplineParams& splines = params.splines;
  const std::vector<double>& at_m = sampling_.distance_m;
  const auto beyond = std::upper_bound(at_m.begin(), at_m.end(), 0.5 * splines.length_m);
  first_points_ = static_cast<std::size_t>(beyond - at_m.begin());
  sum_of_weights_.push_back(0.0);
  for (const double weight : sampling_.weight) {
    sum_of_weights_.push_back(sum_of_weights_.back() + weight);
  }
  const auto first_knots = static_cast<std::size_t>(splines.num_first_knots);
  const auto second_knots = static_cast<std::size_t>(splines.num_second_knots);
  for (std::size_t i = 0; i < first_knots; ++i) {
    for (std::size_t j = 0; j < second_knots; ++j) {
      second_halves_.push_back(
          MakeSecondHalf(ArcCurvature(i, first_knots, splines.max_curvature_per_m),
                         ArcCurvature(j, second_knots, splines.max_curvature_per_m)));
    }
  }
}

SplineVoter::SecondHalf SplineVoter::MakeSecondHalf(double first_knot_per_m,
                                                    double second_knot_per_m) const {
  const GestaltSplineParams& splines = params_.splines;
  SecondHalf half;
  half.spline = {first_knot_per_m, first_knot_per_m, second_knot_per_m, splines.length_m};
  const double knot_m = 0.5 * splines.length_m;
  half.feasible =
      law_.LargestRateInTime(first_knot_per_m, second_knot_per_m, knot_m, full_speed_m_s_) <=
      splines.max_curvature_rate_per_m_s;
  ClothoidPoint point;
  double driven_m = knot_m;
  for (std::size_t k = first_points_; k < sampling_.distance_m.size(); ++k) {
    const double next_m = sampling_.distance_m[k];
    point = Joined(point, AlongSpline(half.spline, driven_m, next_m, law_));
    driven_m = next_m;
    half.points.push_back(point);
    half.largest_turn_rad = std::max(half.largest_turn_rad, std::abs(point.heading_rad));
  }
  if (splines.waypoint_m > knot_m) {
    half.at_waypoint = AlongSpline(half.spline, knot_m, splines.waypoint_m, law_);
  }
  return half;
}

SplineVotes SplineVoter::Vote(const GoodnessGrid& grid, const PoseEstimate& start,
                              double curvature_per_m, const messages::Goal& goal) const {
  const GoalDirection goal_R = TowardsGoal(start, goal);
  const double waypoint_m =
      std::max(kOnGoal_m, std::min(params_.splines.waypoint_m, goal_R.distance_m));
  const Question question{.grid = grid,
                          .start_W = AsPoint(start),
                          .goal_W = goal,
                          .count = sampling_.CountWithin(goal_R.distance_m),
                          .waypoint_m = waypoint_m,
                          .peak = WaypointPeak(goal_R, +1),
                          .index_per_rad =
                              1.0 / (params_.drive.step_m * ArcSpacing(params_.arcs))};
  SplineVotes votes;
  votes.reserve(second_halves_.size());
  const auto second_knots = static_cast<std::size_t>(params_.splines.num_second_knots);
  for (std::size_t i = 0; i < second_halves_.size(); i += second_knots) {
    Spline spline = second_halves_[i].spline;
    spline.start_per_m = curvature_per_m;
    const FirstHalf first = MakeFirstHalf(spline, question);
    for (std::size_t j = i; j < i + second_knots; ++j) {
      votes.push_back(VoteOn(first, second_halves_[j], question));
    }
  }
  return votes;
}

SplineVoter::FirstHalf SplineVoter::MakeFirstHalf(const Spline& spline,
                                                  const Question& question) const {
  const double knot_m = 0.5 * spline.length_m;
  FirstHalf half(params_.plan.unknown_cells);
  half.spline = spline;
  half.feasible = law_.LargestRateInTime(spline.start_per_m, spline.first_knot_per_m, knot_m,
                                         full_speed_m_s_) <=
                  params_.splines.max_curvature_rate_per_m_s;
  ClothoidPoint point = question.start_W;
  double driven_m = 0.0;
  const std::size_t count = std::min(first_points_, question.count);
  for (std::size_t k = 0; k < count; ++k) {
    const double next_m = sampling_.distance_m[k];
    point = Joined(point, AlongSpline(spline, driven_m, next_m, law_));
    driven_m = next_m;
    const double turned_rad = std::abs(point.heading_rad - question.start_W.heading_rad);
    half.turned_enough = k > 0 && turned_rad > params_.plan.max_path_turn_rad;
    if (half.turned_enough) break;
    half.sums.Add(question.grid.At(point.x_m, point.y_m), sampling_.weight[k]);
    ++half.count;
  }
  half.end_W = Joined(point, AlongSpline(spline, driven_m, knot_m, law_));
  if (question.waypoint_m <= knot_m) {
    half.at_waypoint_W =
        Joined(question.start_W, AlongSpline(spline, 0.0, question.waypoint_m, law_));
  }
  return half;
}

HazardVote SplineVoter::JudgeWhole(const FirstHalf& first, const SecondHalf& second,
                                   const Question& question) const {
  PathSums sums = first.sums;
  const double cosine = std::cos(first.end_W.heading_rad);
  const double sine = std::sin(first.end_W.heading_rad);
  const double turned_rad = first.end_W.heading_rad - question.start_W.heading_rad;
  const double limit_rad = params_.plan.max_path_turn_rad;
  const bool may_turn_enough = std::abs(turned_rad) + second.largest_turn_rad > limit_rad;
  std::size_t count = first.count;
  const std::size_t end = first.turned_enough ? count : question.count;
  for (; count < end; ++count) {
    const ClothoidPoint& p = second.points[count - first_points_];
    const bool turned_enough =
        may_turn_enough && std::abs(turned_rad + p.heading_rad) > limit_rad;
    if (turned_enough && count > 0) break;
    // p_W = p_WK + Rz(heading) p_K, with K the frame at the first knot.
    sums.Add(question.grid.At(first.end_W.x_m + cosine * p.x_m - sine * p.y_m,
                              first.end_W.y_m + sine * p.x_m + cosine * p.y_m),
             sampling_.weight[count]);
  }
  return sums.Vote(sum_of_weights_[count], question.grid.unknown,
                   params_.votes.min_allowed_goodness);
}

ClothoidPoint SplineVoter::AtWaypoint(const FirstHalf& first, const SecondHalf& second,
                                      const Question& question) const {
  const double knot_m = 0.5 * second.spline.length_m;
  if (question.waypoint_m <= knot_m) return first.at_waypoint_W;
  const bool whole = question.waypoint_m == params_.splines.waypoint_m;
  return Joined(first.end_W, whole ? second.at_waypoint
                                   : AlongSpline(second.spline, knot_m, question.waypoint_m, law_));
}

SplineVote SplineVoter::VoteOn(const FirstHalf& first, const SecondHalf& second,
                               const Question& question) const {
  const bool whole = params_.votes.whole_numbers;
  const HazardVote hazard = RoundedVote(JudgeWhole(first, second, question), whole);
  const ClothoidPoint place_W = AtWaypoint(first, second, question);
  const GoalDirection goal =
      TowardsGoal({.x_m = place_W.x_m, .y_m = place_W.y_m, .heading_rad = place_W.heading_rad},
                  question.goal_W);
  SplineVote vote;
  vote.spline = first.spline;
  vote.spline.second_knot_per_m = second.spline.second_knot_per_m;
  vote.hazard = hazard.goodness;
  vote.hazard_certainty = hazard.certainty;
  // e, positive where the goal is on the left; index = e / (step spacing).
  vote.waypoint_error_rad = MissedBy(goal, params_.waypoints.goal_tolerance_m);
  vote.waypoint = RoundedVote(
      WaypointVote(question.peak, vote.waypoint_error_rad * question.index_per_rad,
                   params_.waypoints.vote_index_variance),
      whole);
  vote.merged = RoundedVote(MergeVotes(hazard, vote.waypoint, params_.waypoints.waypoint_certainty,
                                       params_.votes.min_vote_goodness),
                            whole);
  vote.feasible = first.feasible && second.feasible;
  return vote;
}

const SplineVote* ChooseSpline(std::span<const SplineVote> votes, const GestaltParams& params) {
  const auto worth = [](const SplineVote& vote) {
    return std::make_tuple(vote.merged, -std::round(Steering(vote.spline) / kEqual),
                           -std::round(std::abs(vote.waypoint_error_rad) / kEqual));
  };
  const SplineVote* best = nullptr;
  for (const SplineVote& vote : votes) {
    const bool may_be_driven = vote.feasible && vote.hazard > params.drive.min_drive_goodness;
    if (!may_be_driven) continue;
    // Splines run from right to left: of equals the first.
    if (best == nullptr || worth(vote) > worth(*best)) best = &vote;
  }
  return best;
}

}  // namespace rockyard::navigation
