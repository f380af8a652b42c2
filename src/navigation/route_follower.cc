#include "navigation/route_follower.h"

#include <cmath>
#include <utility>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"
#include "navigation/waypoint_sequence.h"

namespace rockyard::navigation {

using messages::MotionCommand;
using messages::MotionKind;

// Neither the end nor the speed of a command counts: the end of a plan moves on with each plan that
// confirms it, and a speed changes no path.
bool MotionFollower::Begins(const MotionCommand& command) const {
  return command.kind != last_.kind || command.curvature_per_m != last_.curvature_per_m ||
         command.direction != last_.direction ||
         command.curvature_rate_per_m2 != last_.curvature_rate_per_m2 || command.move != last_.move;
}

MotionCommand MotionFollower::Follow(const MotionCommand& command, double odometer_m,
                                     double tick_s) {
  EXPECT(tick_s > 0.0);
  EXPECT(command.speed_share > 0.0 && command.speed_share <= 1.0);
  if (Begins(command)) began_m_ = odometer_m;
  last_ = command;
  if (command.kind != MotionKind::kArc) return command;
  const double speed_m_s = command.speed_share * full_speed_m_s_;
  if (odometer_m + speed_m_s * (tick_s + 0.5 * ramp_s_) > command.end_m) return {};
  MotionCommand motion = command;
  // Without a rate the curvature keeps its bits, the sign of a zero too.
  if (command.curvature_rate_per_m2 != 0.0) {
    const double middle_m = odometer_m + 0.5 * speed_m_s * tick_s;
    motion.curvature_per_m += command.curvature_rate_per_m2 * (middle_m - began_m_);
  }
  return motion;
}

using messages::MotionKind;
using messages::PoseEstimate;

RouteFollower::RouteFollower(const RouteParams& params, messages::Route route)
    : params_(params), route_(std::move(route)) {}

NavigatorDecision RouteFollower::Decide(const NavigatorInput& input) {
  const PoseEstimate& estimate = input.estimate;
  if (route_.corners.empty()) return {NavigatorStatus::kGaveUp, {}, {}};
  if (BearingTo(route_.corners.back(), estimate).distance_m <= params_.goal_tolerance_m) {
    return {NavigatorStatus::kArrived, {}, {}};
  }
  PassCorners(estimate);
  const Bearing bearing = BearingTo(route_.corners[next_], estimate);
  const bool turning = under_way_ && motion_.kind == MotionKind::kTurnInPlace;
  // A turn goes on until the corner is ahead, an arc for steer_interval_m of driving.
  const bool on = turning ? motion_.direction * bearing.angle_rad > params_.heading_deadband_rad
                          : under_way_ && !NeedsPointTurn(bearing) &&
                                estimate.distance_m - steered_at_m_ < params_.steer_interval_m;
  if (on) return {NavigatorStatus::kDriving, {}, motion_};
  return Steer(bearing, estimate);
}

// The motion under way is worked out anew from where the rover now stands.
void RouteFollower::OnPoseUpdate(const PoseEstimate&, const PoseEstimate&) { under_way_ = false; }

void RouteFollower::SetGoal(const messages::Goal& goal, GoalChange) {
  if (!route_.corners.empty()) route_.corners.back() = goal;
}

RouteFollower::Bearing RouteFollower::BearingTo(const messages::Goal& corner,
                                                const PoseEstimate& estimate) const {
  const double dx = corner.x_m - estimate.x_m;
  const double dy = corner.y_m - estimate.y_m;
  return {math::Hypot(dx, dy), math::WrapAngle(math::Atan2(dy, dx) - estimate.heading_rad)};
}

void RouteFollower::PassCorners(const PoseEstimate& estimate) {
  // The first leg begins where the rover stands when it first decides.
  if (!leg_from_) leg_from_ = messages::Goal{estimate.x_m, estimate.y_m};
  while (next_ + 1 < route_.corners.size() &&
         HasPassed(route_.corners[next_], *leg_from_, estimate, params_.corner_tolerance_m)) {
    leg_from_ = route_.corners[next_];
    ++next_;
  }
}

// The arc that leads to a corner at distance d and bearing b has the radius d / (2 sin b).
bool RouteFollower::NeedsPointTurn(const Bearing& bearing) const {
  const double bearing_rad = std::abs(bearing.angle_rad);
  if (bearing_rad <= params_.heading_deadband_rad) return false;
  return bearing_rad > params_.point_turn_bearing_rad ||
         bearing.distance_m < 2.0 * params_.tight_arc_radius_m * math::Sin(bearing_rad);
}

NavigatorDecision RouteFollower::Steer(const Bearing& bearing, const PoseEstimate& estimate) {
  under_way_ = true;
  steered_at_m_ = estimate.distance_m;
  if (NeedsPointTurn(bearing)) {
    motion_ = {MotionKind::kTurnInPlace, 0.0, bearing.angle_rad > 0.0 ? +1 : -1};
  } else {
    const bool straight = std::abs(bearing.angle_rad) <= params_.heading_deadband_rad;
    // The circle tangent to the heading through a point at distance d and bearing b: c = 2 sin(b) /
    // d.
    const double curvature_per_m =
        straight ? 0.0 : 2.0 * math::Sin(bearing.angle_rad) / bearing.distance_m;
    motion_ = {MotionKind::kArc, curvature_per_m, +1};
  }
  return {NavigatorStatus::kDriving, {}, motion_};
}

NavigatorDescription<RouteParams> DescribeRouteFollower() {
  return {.name = "route",
          .doc =
              "follower of a route that was planned before (course.route_map): with an oracle's "
              "perfect path selection",
          .traits = [](const RouteParams& params) -> NavigatorTraits {
            NavigatorTraits traits(LookReading::kNothing, CostOfLook{},
                                   {"goal_tolerance_m", params.goal_tolerance_m});
            traits.follows_route = true;
            return traits;
          },
          .make = [](const RouteParams& params,
                     const NavigatorSetup& setup) -> std::unique_ptr<Navigator> {
            return std::make_unique<RouteFollower>(params, setup.route);
          }};
}

}  // namespace rockyard::navigation
