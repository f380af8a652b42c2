// Plain votes on splines to compare the fast ones with: every spline is made anew from its start,
// each of its places by one integral from there, and judged by VoteOnPath.
#pragma once

#include <cmath>
#include <vector>

#include "navigation/gestalt/splines.h"

namespace rockyard::navigation {

inline bool RateIsFeasible(const GestaltParams& params, double full_speed_m_s,
                           const Spline& spline) {
  const CurvatureLaw law(params.splines.law, params.speed);
  // The largest change in time between places that are close together, by the speed law. Just
  // beyond a knot stands for just at it.
  for (int i = 0; i < 2000; ++i) {
    const double s_m = spline.length_m * (i + 0.5) / 2000.0;
    const double share = params.speed.min_speed_share;
    const double way =
        (std::abs(CurvatureAt(spline, s_m, law)) - params.speed.full_speed_curvature_per_m) /
        (params.speed.slow_curvature_per_m - params.speed.full_speed_curvature_per_m);
    const double speed_m_s =
        full_speed_m_s * (1.0 - (1.0 - share) * std::min(1.0, std::max(0.0, way)));
    const double rate = std::abs(CurvatureRateAt(spline, s_m, law)) * speed_m_s;
    if (rate > params.splines.max_curvature_rate_per_m_s) return false;
  }
  return true;
}

inline messages::SplineVote ReferenceVote(const GestaltParams& params, const GoodnessGrid& grid,
                                          const messages::PoseEstimate& start,
                                          const messages::Goal& goal, const Spline& spline) {
  const CurvatureLaw law(params.splines.law, params.speed);
  const PathSampling sampling =
      SamplePaths(params.plan, std::min(params.map.grid.xstep_m, params.map.grid.ystep_m));
  const double distance_m = std::hypot(goal.x_m - start.x_m, goal.y_m - start.y_m);
  std::vector<PathPoint> points;
  for (std::size_t k = 0; k < sampling.CountWithin(distance_m); ++k) {
    const math::Pose2 p = AlongSpline({}, spline, 0.0, sampling.distance_m[k], law);
    if (k > 0 && std::abs(p.heading_rad) > params.plan.max_path_turn_rad) break;
    points.push_back({p.x_m, p.y_m});
  }
  HazardVote hazard = VoteOnPath(grid, start, points, sampling.weight,
                                 params.votes.min_allowed_goodness, params.plan.unknown_cells);
  const auto rounded = [&params](double vote) {
    return params.votes.whole_numbers ? std::floor(vote + 0.5) : vote;
  };
  hazard = {rounded(hazard.goodness), rounded(hazard.certainty)};
  messages::SplineVote vote;
  vote.spline = spline;
  vote.hazard = hazard.goodness;
  vote.hazard_certainty = hazard.certainty;
  // e: between the heading after w and the direction from there to the goal.
  const double w_m = std::min(params.splines.waypoint_m, distance_m);
  const math::Pose2 p = AlongSpline({}, spline, 0.0, w_m, law);
  const double cosine = std::cos(start.heading_rad);
  const double sine = std::sin(start.heading_rad);
  const double to_x = goal.x_m - start.x_m - cosine * p.x_m + sine * p.y_m;
  const double to_y = goal.y_m - start.y_m - sine * p.x_m - cosine * p.y_m;
  const double heading = start.heading_rad + p.heading_rad;
  vote.waypoint_error_rad = std::atan2(std::cos(heading) * to_y - std::sin(heading) * to_x,
                                       std::cos(heading) * to_x + std::sin(heading) * to_y);
  // The goal is a disc.
  const double width = std::min(1.0, params.waypoints.goal_tolerance_m / std::hypot(to_x, to_y));
  double miss = std::max(0.0, std::abs(vote.waypoint_error_rad) - std::asin(width));
  if (width >= 1.0) miss = 0.0;
  const double spacing =
      2.0 * params.arcs.max_curvature_per_m / static_cast<double>(params.arcs.num_forward_arcs - 1);
  const double index = miss / (params.drive.step_m * spacing);
  const bool ahead = cosine * (goal.x_m - start.x_m) + sine * (goal.y_m - start.y_m) >= 0.0;
  vote.waypoint = rounded((ahead ? 255.0 : 128.0) *
                          std::exp(-0.5 * index * index / params.waypoints.vote_index_variance));
  vote.merged = rounded(MergeVotes(hazard, vote.waypoint, params.waypoints.waypoint_certainty,
                                   params.votes.min_vote_goodness));
  return vote;
}

// All splines, without whether they are feasible; by the first knot from right to left, then by the
// second one.
inline SplineVotes ReferenceVotes(const GestaltParams& params, const GoodnessGrid& grid,
                                  const messages::PoseEstimate& start, double curvature_per_m,
                                  const messages::Goal& goal) {
  const GestaltSplineParams& p = params.splines;
  const auto knot = [&p](std::int64_t i, std::int64_t count) {
    if (count == 1) return 0.0;
    return p.max_curvature_per_m *
           (static_cast<double>(2 * i - (count - 1)) / static_cast<double>(count - 1));
  };
  SplineVotes votes;
  for (std::int64_t i = 0; i < p.num_first_knots; ++i) {
    for (std::int64_t j = 0; j < p.num_second_knots; ++j) {
      votes.push_back(ReferenceVote(
          params, grid, start, goal,
          {curvature_per_m, knot(i, p.num_first_knots), knot(j, p.num_second_knots), p.length_m}));
    }
  }
  return votes;
}

}  // namespace rockyard::navigation
