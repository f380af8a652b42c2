#include "navigation/gestalt/splines.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::navigation {
namespace {

using messages::PoseEstimate;
using messages::SplineVote;

// Steering and errors closer than this are equal, whatever rounding made of them.
constexpr double kEqual = 1e-9;

// Returns the spacing of the arcs in curvature, 1/m; a single arc is as wide as all of them.
double ArcSpacing(const GestaltArcParams& arcs) {
  const std::int64_t gaps = std::max<std::int64_t>(1, arcs.num_forward_arcs - 1);
  return 2.0 * arcs.max_curvature_per_m / static_cast<double>(gaps);
}

// Returns the angle by which a rover that heads straight on misses a goal of that radius,
//   e = max(0, |bearing| - asin(radius / distance)), 0 within it.
double MissedBy(const GoalDirection& goal, double radius_m) {
  if (goal.distance_m <= radius_m) return 0.0;
  return std::max(0.0, std::abs(goal.bearing_rad) - math::Asin(radius_m / goal.distance_m));
}

// Returns the changes of curvature along a spline, 1/m.
double Steering(const Spline& spline) {
  return std::abs(spline.first_knot_per_m - spline.start_per_m) +
         std::abs(spline.second_knot_per_m - spline.first_knot_per_m);
}

}  // namespace

// Where a frame K lies in the frame of the grid and of the estimate, W here and O in the drive
// cycle.
struct SplineVoter::Frame {
  explicit Frame(const math::Pose2& place_W)
      : place(place_W),
        cosine(math::Cos(place_W.heading_rad)),
        sine(math::Sin(place_W.heading_rad)) {}

  // p_W = p_WK + Rz(heading) p_K.
  math::Pose2 InW(const math::Pose2& p_K) const {
    return {place.x_m + cosine * p_K.x_m - sine * p_K.y_m,
            place.y_m + sine * p_K.x_m + cosine * p_K.y_m, place.heading_rad + p_K.heading_rad};
  }

  math::Pose2 place;
  double cosine;
  double sine;
};

// What is asked of all splines of one Vote.
struct SplineVoter::Question {
  const GoodnessGrid& grid;
  math::Pose2 start_W;
  messages::Goal goal_W;
  std::size_t count = 0;    // points that are judged
  double waypoint_m = 0.0;  // where the waypoint vote is asked
  double peak = 0.0;        // of the waypoint votes
  double index_per_rad = 0.0;
};

// What the splines of one first knot share.
struct SplineVoter::FirstHalf {
  Spline spline;  // of any second knot
  PathSums sums;
  std::size_t count = 0;  // points in the sums
  bool turned_enough = false;
  Frame knot;
  math::Pose2 at_waypoint_W;  // if that is before the knot
  bool feasible = false;
};

// Where the points of the second halves of one first knot lie in the grid, in cells, [spline][k].
struct SplineVoter::Cells {
  explicit Cells(std::size_t count) : column(count), row(count) {}

  std::size_t first_spline = 0;
  std::vector<double> column;
  std::vector<double> row;
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
  const auto beyond = std::lower_bound(at_m.begin(), at_m.end(), Knot_m());
  first_points_ = static_cast<std::size_t>(beyond - at_m.begin());
  second_points_ = at_m.size() - first_points_;
  sum_of_weights_.push_back(0.0);
  for (const double weight : sampling_.weight) {
    sum_of_weights_.push_back(sum_of_weights_.back() + weight);
  }
  const auto first_knots = static_cast<std::size_t>(splines.num_first_knots);
  const auto second_knots = static_cast<std::size_t>(splines.num_second_knots);
  for (std::size_t i = 0; i < first_knots; ++i) {
    for (std::size_t j = 0; j < second_knots; ++j) {
      AddSecondHalf(ArcCurvature(i, first_knots, splines.max_curvature_per_m),
                    ArcCurvature(j, second_knots, splines.max_curvature_per_m));
    }
  }
}

void SplineVoter::AddSecondHalf(double first_knot_per_m, double second_knot_per_m) {
  const GestaltSplineParams& splines = params_.splines;
  SecondHalf half;
  half.spline = {first_knot_per_m, first_knot_per_m, second_knot_per_m, splines.length_m};
  half.feasible = IsFeasible(first_knot_per_m, second_knot_per_m);
  math::Pose2 point;
  double driven_m = Knot_m();
  for (std::size_t k = first_points_; k < sampling_.distance_m.size(); ++k) {
    point = AlongSpline(point, half.spline, driven_m, sampling_.distance_m[k], law_);
    driven_m = sampling_.distance_m[k];
    points_K_.x_m.push_back(point.x_m);
    points_K_.y_m.push_back(point.y_m);
    points_K_.heading_rad.push_back(point.heading_rad);
    half.largest_turn_rad = std::max(half.largest_turn_rad, std::abs(point.heading_rad));
  }
  second_halves_.push_back(half);
  if (splines.waypoint_m >= Knot_m()) {
    second_halves_.back().at_waypoint = AtWaypoint(second_halves_.size() - 1, splines.waypoint_m);
  }
}

SplineVotes SplineVoter::Vote(const GoodnessGrid& grid, const PoseEstimate& start,
                              double curvature_per_m, const messages::Goal& goal) const {
  const GoalDirection goal_R = TowardsGoal(start, goal);
  const Question question{.grid = grid,
                          .start_W = Planar(start),
                          .goal_W = goal,
                          .count = sampling_.CountWithin(goal_R.distance_m),
                          .waypoint_m = std::min(params_.splines.waypoint_m, goal_R.distance_m),
                          .peak = WaypointPeak(goal_R, +1),
                          .index_per_rad = 1.0 / (params_.drive.step_m * ArcSpacing(params_.arcs))};
  SplineVotes votes(second_halves_.size());
  const auto second_knots = static_cast<std::size_t>(params_.splines.num_second_knots);
  Cells cells(second_knots * second_points_);
  for (std::size_t i = 0; i < second_halves_.size(); i += second_knots) {
    Spline spline = second_halves_[i].spline;
    spline.start_per_m = curvature_per_m;
    const FirstHalf first = MakeFirstHalf(spline, question);
    FindCells(first.knot, i, grid, cells);
    for (std::size_t j = i; j < i + second_knots; ++j) VoteOn(first, j, cells, question, votes[j]);
  }
  return votes;
}

SplineVoter::FirstHalf SplineVoter::MakeFirstHalf(const Spline& spline,
                                                  const Question& question) const {
  const double knot_m = Knot_m();
  PathSums sums(params_.plan.unknown_cells);
  math::Pose2 point = question.start_W;
  double driven_m = 0.0;
  std::size_t count = 0;
  bool turned_enough = false;
  for (; count < std::min(first_points_, question.count); ++count) {
    const double next_m = sampling_.distance_m[count];
    point = AlongSpline(point, spline, driven_m, next_m, law_);
    driven_m = next_m;
    turned_enough = count > 0 && TurnedEnough(point.heading_rad - question.start_W.heading_rad);
    if (turned_enough) break;
    sums.Add(question.grid.At(point.x_m, point.y_m), sampling_.weight[count]);
  }
  math::Pose2 at_waypoint_W;
  if (question.waypoint_m < knot_m) {
    at_waypoint_W = AlongSpline(question.start_W, spline, 0.0, question.waypoint_m, law_);
  }
  return {.spline = spline,
          .sums = sums,
          .count = count,
          .turned_enough = turned_enough,
          .knot = Frame(AlongSpline(point, spline, driven_m, knot_m, law_)),
          .at_waypoint_W = at_waypoint_W,
          .feasible = IsFeasible(spline.start_per_m, spline.first_knot_per_m)};
}

void SplineVoter::FindCells(const Frame& knot, std::size_t first_spline, const GoodnessGrid& grid,
                            Cells& cells) const {
  cells.first_spline = first_spline;
  const double* x_m = points_K_.x_m.data() + first_spline * second_points_;
  const double* y_m = points_K_.y_m.data() + first_spline * second_points_;
  // p_W = p_WK + Rz(heading) p_K, in cells as GoodnessGrid::At counts them.
  for (std::size_t k = 0; k < cells.column.size(); ++k) {
    cells.column[k] =
        (knot.place.x_m + knot.cosine * x_m[k] - knot.sine * y_m[k] - grid.x0_m) / grid.xstep_m;
    cells.row[k] =
        (knot.place.y_m + knot.sine * x_m[k] + knot.cosine * y_m[k] - grid.y0_m) / grid.ystep_m;
  }
}

std::size_t SplineVoter::CountJudged(const FirstHalf& first, std::size_t spline,
                                     const Question& question) const {
  if (first.turned_enough) return first.count;
  const double turned_rad = first.knot.place.heading_rad - question.start_W.heading_rad;
  const double largest_rad = std::abs(turned_rad) + second_halves_[spline].largest_turn_rad;
  if (!TurnedEnough(largest_rad)) return question.count;
  const double* heading_rad = points_K_.heading_rad.data() + spline * second_points_;
  std::size_t count = first.count;
  for (; count < question.count; ++count) {
    const bool turned_enough = TurnedEnough(turned_rad + heading_rad[count - first_points_]);
    if (turned_enough && count > 0) break;
  }
  return count;
}

HazardVote SplineVoter::JudgeWhole(const FirstHalf& first, std::size_t spline, const Cells& cells,
                                   const Question& question) const {
  PathSums sums = first.sums;
  const std::size_t count = CountJudged(first, spline, question);
  const std::size_t first_cell = (spline - cells.first_spline) * second_points_;
  for (std::size_t k = first.count; k < count; ++k) {
    const std::size_t cell = first_cell + k - first_points_;
    sums.Add(question.grid.AtCells(cells.column[cell], cells.row[cell]), sampling_.weight[k]);
  }
  return sums.Vote(sum_of_weights_[count], question.grid.unknown,
                   params_.votes.min_allowed_goodness);
}

math::Pose2 SplineVoter::AtWaypoint(std::size_t spline, double waypoint_m) const {
  // Begins at the last of the spline's points that is not beyond, or at the knot.
  const Spline& knots = second_halves_[spline].spline;
  const std::size_t count = sampling_.CountWithin(waypoint_m);
  if (count <= first_points_ || sampling_.distance_m[count - 1] > waypoint_m) {
    return AlongSpline({}, knots, Knot_m(), waypoint_m, law_);
  }
  const std::size_t last = spline * second_points_ + count - 1 - first_points_;
  return AlongSpline({points_K_.x_m[last], points_K_.y_m[last], points_K_.heading_rad[last]}, knots,
                     sampling_.distance_m[count - 1], waypoint_m, law_);
}

void SplineVoter::VoteOn(const FirstHalf& first, std::size_t spline, const Cells& cells,
                         const Question& question, SplineVote& vote) const {
  const bool whole = params_.votes.whole_numbers;
  const HazardVote hazard = RoundedVote(JudgeWhole(first, spline, cells, question), whole);
  vote.spline = first.spline;
  vote.spline.second_knot_per_m = second_halves_[spline].spline.second_knot_per_m;
  vote.feasible = first.feasible && second_halves_[spline].feasible;
  vote.hazard = hazard.goodness;
  vote.hazard_certainty = hazard.certainty;
  const GoalDirection goal = FromWaypoint(first, spline, question);
  vote.waypoint_error_rad = goal.bearing_rad;
  // index = e / (step spacing).
  const double miss_rad = MissedBy(goal, params_.waypoints.goal_tolerance_m);
  vote.waypoint = RoundedVote(WaypointVote(question.peak, miss_rad * question.index_per_rad,
                                           params_.waypoints.vote_index_variance),
                              whole);
  vote.merged = RoundedVote(MergeVotes(hazard, vote.waypoint, params_.waypoints.waypoint_certainty,
                                       params_.votes.min_vote_goodness),
                            whole);
}

GoalDirection SplineVoter::FromWaypoint(const FirstHalf& first, std::size_t spline,
                                        const Question& question) const {
  math::Pose2 place_W = first.at_waypoint_W;
  if (question.waypoint_m >= Knot_m()) {
    const bool whole = question.waypoint_m == params_.splines.waypoint_m;
    place_W = first.knot.InW(whole ? second_halves_[spline].at_waypoint
                                   : AtWaypoint(spline, question.waypoint_m));
  }
  return TowardsGoal({.x_m = place_W.x_m, .y_m = place_W.y_m, .heading_rad = place_W.heading_rad},
                     question.goal_W);
}

bool SplineVoter::IsFeasible(double from_per_m, double to_per_m) const {
  return law_.LargestRateInTime(from_per_m, to_per_m, Knot_m(), full_speed_m_s_) <=
         params_.splines.max_curvature_rate_per_m_s;
}

bool SplineVoter::TurnedEnough(double turned_rad) const {
  return std::abs(turned_rad) > params_.plan.max_path_turn_rad;
}

double SplineVoter::Knot_m() const { return 0.5 * params_.splines.length_m; }

const SplineVote* ChooseSpline(std::span<const SplineVote> votes, const GestaltParams& params) {
  // Values are compared in whole steps of kEqual: to call two equal that lie closer than kEqual
  // would be no order, as it is not transitive.
  const auto worth = [](const SplineVote& vote) {
    return std::make_tuple(vote.merged, -std::round(Steering(vote.spline) / kEqual),
                           -std::round(std::abs(vote.waypoint_error_rad) / kEqual));
  };
  const SplineVote* best = nullptr;
  for (const SplineVote& vote : votes) {
    const bool may_be_driven = vote.feasible && vote.hazard > params.drive.min_drive_goodness;
    if (!may_be_driven) continue;
    // Splines run from right to left: the first of equals is taken.
    if (best == nullptr || worth(vote) > worth(*best)) best = &vote;
  }
  return best;
}

}  // namespace rockyard::navigation
