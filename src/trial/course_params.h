// Where a trial starts, where it leads and by which waypoints, and how near counts as there.
#pragma once

#include <cstdint>
#include <vector>

#include "core/fields.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "sensing/feature_tracker_params.h"
#include "trial/designation_params.h"
#include "trial/goal_rock_params.h"
#include "trial/lander_map_params.h"
#include "trial/route_map_params.h"
#include "trial/route_plan_params.h"
#include "trial/waypoint_params.h"

namespace rockyard::trial {

struct CourseParams {
  double start_x_m = 0.0;
  double start_y_m = 0.0;
  double start_heading_rad = 0.0;
  double goal_x_m = 7.6;
  double goal_y_m = 0.0;
  WaypointParams waypoints;
  double goal_radius_m = 0.65;
  double target_speed_m_s = 0.0;  // of the goal itself
  double target_heading_rad = 0.0;
  std::int64_t trials_per_layout = 1;
  DesignationParams designation;
  sensing::FeatureTrackerParams tracking;
  RoutePlanParams oracle_route;
  RouteMapParams route_map;
  LanderMapParams lander_map;
  GoalRockParams goal_rock;

  math::Pose2 Start() const { return {start_x_m, start_y_m, start_heading_rad}; }

  // The true places that the rover drives to one after the other, in W: every waypoint, then the
  // goal.
  std::vector<messages::Goal> Goals() const;

  // The true goal at a simulated time, which is goal_x_m, goal_y_m where the target stands.
  messages::Goal GoalAt(double time_s) const;

  // Where the lander's cameras stand, in W; the start where start and goal are one.
  messages::Goal LanderPlace() const;

  // From the lander's cameras to a place in W; 0 where start and goal are one, which Visit refuses.
  double DesignationRange_m(const messages::Goal& place) const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial
