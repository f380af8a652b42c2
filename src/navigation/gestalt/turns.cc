#include "navigation/gestalt/turns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "math/angles.h"
#include "math/functions.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

using messages::Goal;
using messages::PoseEstimate;

// Directions that are looked into beside that of the goal, all round: one every 5 deg.
constexpr int kDirections = 72;

}  // namespace

RemedyTurns::RemedyTurns(const GestaltParams& params)
    : params_(params),
      sampling_(
          SamplePaths(params.plan, std::min(params.map.grid.xstep_m, params.map.grid.ystep_m))) {
  for (const double s_m : sampling_.distance_m) straight_.push_back({s_m, 0.0});
}

RemedyTurn RemedyTurns::InsteadOf(std::optional<double> goes_on_m, double turned_rad,
                                  const GoodnessGrid& grid, const PlanOrigin& origin,
                                  const Goal& goal, const WayToGo& way) const {
  const TurnFirstParams& first = params_.remedies.turn_first;
  const StopToTurnParams& stops = params_.remedies.stop_to_turn;
  const bool stops_to_turn = stops.enabled && params_.continuous.cycle == DriveCycle::kCsad;
  if (!first.enabled && !stops_to_turn) return {};
  const bool orbits = stops_to_turn && turned_rad > stops.orbit_turn_rad;
  const Turn turn =
      BestTurn(orbits ? Directions::kAllRound : Sensible(), grid, origin.pose, goal, way);
  if (!std::isfinite(turn.way_m)) return {};
  const bool far_aside = std::abs(turn.angle_rad) > first.bearing_rad;
  const bool saves = !goes_on_m || *goes_on_m - turn.way_m > stops.saves_m;
  const bool instead = stops_to_turn
                           ? saves || orbits || LiesInsideTightestCircle(origin.pose, goal)
                           : saves && (far_aside || (!goes_on_m && SearchesWay()));
  if (!instead) return {};
  return {turn.angle_rad, !goes_on_m && turn.seen};
}

RemedyTurns::Directions RemedyTurns::Sensible() const {
  return SearchesWay() ? Directions::kAllRound : Directions::kTowardsGoal;
}

RemedyTurns::Turn RemedyTurns::BestTurn(Directions directions, const GoodnessGrid& grid,
                                        const PoseEstimate& pose, const Goal& goal,
                                        const WayToGo& way) const {
  const double goal_m = TowardsGoal(pose, goal).distance_m;
  const double judged_m = params_.plan.plan_max_dist_m;
  // A searched way bends at any place; a straight one is to be open as far as paths are judged.
  if (directions == Directions::kTowardsGoal) {
    return BestTurnBefore(std::min(judged_m, goal_m), directions, grid, pose, goal, way);
  }
  const double length_m = std::min(0.5 * judged_m, goal_m);
  const Turn turn = BestTurnBefore(length_m, directions, grid, pose, goal, way);
  // The way on gains what is driven of it. In a room too narrow for any straight drive of that
  // length along it, the best of the others leads back.
  if (turn.way_m <= way.From_m(pose.x_m, pose.y_m) + 0.5 * length_m) return turn;
  const Turn shorter = BestTurnBefore(0.5 * length_m, directions, grid, pose, goal, way);
  return shorter.way_m < turn.way_m ? shorter : turn;
}

RemedyTurns::Turn RemedyTurns::BestTurnBefore(double length_m, Directions directions,
                                              const GoodnessGrid& grid, const PoseEstimate& pose,
                                              const Goal& goal, const WayToGo& way) const {
  Turn best{.way_m = std::numeric_limits<double>::infinity()};
  const auto consider = [&](double angle_rad) {
    PoseEstimate turned = pose;
    turned.heading_rad = math::WrapAngle(pose.heading_rad + angle_rad);
    const math::Pose2 end = AlongClothoid(Planar(turned), 0.0, 0.0, length_m);
    const double way_m = length_m + way.From_m(end.x_m, end.y_m);
    if (way_m >= best.way_m) return;
    const HazardVote hazard = VoteOnPath(
        grid, turned, std::span(straight_).first(sampling_.CountWithin(length_m)), sampling_.weight,
        params_.votes.min_allowed_goodness, params_.plan.unknown_cells);
    if (hazard.goodness <= params_.drive.min_drive_goodness) return;
    best = {angle_rad, way_m, grid.At(end.x_m, end.y_m).known};
  };
  consider(TowardsGoal(pose, goal).bearing_rad);
  if (directions == Directions::kTowardsGoal) return best;
  for (int i = 0; i < kDirections; ++i) {
    // From straight ahead to either side, so that the smaller of equal turns is taken.
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const int steps = (i + 1) / 2;
    consider(side * steps * 2.0 * std::numbers::pi / kDirections);
  }
  return best;
}

// The circle of the tightest knots to the goal's side does not touch the goal's disc:
//   |goal - (0, r)|^2 = d^2 + r^2 - 2 d r |sin b| < (r - tolerance)^2.
bool RemedyTurns::LiesInsideTightestCircle(const PoseEstimate& pose, const Goal& goal) const {
  const double inner_m =
      1.0 / params_.splines.max_curvature_per_m - params_.waypoints.goal_tolerance_m;
  if (inner_m <= 0.0) return false;
  const double radius_m = 1.0 / params_.splines.max_curvature_per_m;
  const GoalDirection direct = TowardsGoal(pose, goal);
  const double aside_m = direct.distance_m * std::abs(math::Sin(direct.bearing_rad));
  return direct.distance_m * direct.distance_m + radius_m * (radius_m - 2.0 * aside_m) <
         inner_m * inner_m;
}

}  // namespace rockyard::navigation
