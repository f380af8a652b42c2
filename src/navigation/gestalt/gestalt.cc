#include "navigation/gestalt/gestalt.h"

#include <cmath>
#include <memory>

namespace rockyard::navigation {
namespace {

using messages::Goal;
using messages::PoseEstimate;

CostOfMap CostOf(const GestaltGridParams& grid) {
  return {.cell_m = std::sqrt(grid.xstep_m * grid.ystep_m),
          .area_m2 = (grid.xN_m - grid.x0_m) * (grid.yN_m - grid.y0_m)};
}

}  // namespace

GestaltNavigator::GestaltNavigator(const GestaltParams& params, const Goal& goal,
                                   double full_speed_m_s)
    : goal_W_(goal), cycle_(params, goal, full_speed_m_s) {}

NavigatorDecision GestaltNavigator::Decide(const NavigatorInput& input) {
  NavigatorInput input_O = input;
  input_O.estimate = InO(input.estimate);
  return cycle_.Decide(input_O);
}

void GestaltNavigator::OnPoseUpdate(const PoseEstimate& before, const PoseEstimate& after) {
  cycle_.OnPoseUpdate(InO(before), InO(after));
}

void GestaltNavigator::OnCorrection(const PoseEstimate& before, const PoseEstimate& after) {
  const PoseEstimate before_O = InO(before);
  // X_OW' with X_OW' after = X_OW before: the heading first, then p_O = p_OW + Rz(heading) p_W.
  X_OW_ = {0.0, 0.0, math::WrapAngle(before_O.heading_rad - after.heading_rad)};
  const PoseEstimate turned_O = InO(after);
  X_OW_.x_m = before_O.x_m - turned_O.x_m;
  X_OW_.y_m = before_O.y_m - turned_O.y_m;
  const double left_m = math::SeenFrom(Planar(before), Planar(after)).y_m;
  cycle_.OnCorrection(before_O, InO(after), InO(goal_W_), left_m);
}

void GestaltNavigator::SetGoal(const Goal& goal, GoalChange change) {
  goal_W_ = goal;
  cycle_.SetGoal(InO(goal_W_), change);
}

PoseEstimate GestaltNavigator::InO(const PoseEstimate& estimate_W) const {
  const math::Pose2 pose_O = X_OW_ * Planar(estimate_W);
  return {pose_O.x_m, pose_O.y_m, pose_O.heading_rad, estimate_W.distance_m};
}

Goal GestaltNavigator::InO(const Goal& goal_W) const {
  const math::Pose2 goal_O = X_OW_ * math::Pose2{goal_W.x_m, goal_W.y_m, 0.0};
  return {goal_O.x_m, goal_O.y_m};
}

NavigatorDescription<GestaltParams> DescribeGestalt() {
  return {
      .name = "gestalt",
      .doc = "map-based navigator",
      .traits = [](const GestaltParams& params) -> NavigatorTraits {
        const GestaltRoverParams& rover = params.map.rover;
        NavigatorTraits traits(LookReading::kPoints, CostOf(params.map.grid),
                               {"waypoints.goal_tolerance_m", params.waypoints.goal_tolerance_m});
        traits.looks_on_the_move = params.continuous.cycle != DriveCycle::kStopAndLook;
        traits.steers_on_the_move = params.continuous.cycle == DriveCycle::kCsad;
        if (traits.steers_on_the_move) {
          traits.curvature_rates = {.path = "splines.max_curvature_rate_per_m_s",
                                    .limit_per_m_s = params.splines.max_curvature_rate_per_m_s,
                                    .least_per_m2 = params.splines.LeastRate_per_m2()};
        }
        if (!rover.modelled) return traits;
        traits.size =
            BelievedSize{"map.rover.length_m", rover.length_m, "map.rover.width_m", rover.width_m,
                         "use the size of the rover, e.g. \"extends\": "
                         "scenarios/navigation/gestalt_rocky_3_2.json in navigation.gestalt"};
        return traits;
      },
      .make = [](const GestaltParams& params,
                 const NavigatorSetup& setup) -> std::unique_ptr<Navigator> {
        return std::make_unique<GestaltNavigator>(params, setup.goal, setup.full_speed_m_s);
      }};
}

}  // namespace rockyard::navigation
