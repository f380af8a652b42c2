// Where a trial starts, where it leads and by which waypoints, and how near the goal counts as
// arrived. These places are true; the rover is told what goal_designation.h makes of them. The
// referee judges arrival by them, and terrain keeps rocks away from them. Meanings and sources
// stand in the .cc.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "sensing/tracker_params.h"
#include "trial/course/designation_params.h"
#include "trial/course/site_map_params.h"

namespace rockyard::trial {

// By whose knowledge of the rocks a route is planned.
enum class RouteMap {
  kOracle,  // the true rocks
  kLander,  // those that the lander's stereo pair shows (goal_designation.h)
};

// Who drives along a route.
enum class RouteUse {
  kNavigator,  // the navigator that follows a route, blind to hazards
  kWaypoints,  // any other navigator: the corners are places to drive to before the goal
};

// The map and the use of a route.
struct RouteMapParams {
  RouteMap source = RouteMap::kOracle;
  RouteUse use = RouteUse::kNavigator;
  double spacing_m = 0.5;
  double passing_m = 0.3;

  void Visit(core::FieldVisitor& v);
};

// How PlanRoute (route_planner.h) plans a route, on whichever map.
struct RoutePlanParams {
  double cell_m = 0.05;
  double margin_m = 0.05;
  double low_rock_m = 0.05;

  void Visit(core::FieldVisitor& v) {
    v.Real("cell_m", cell_m,
           core::Assumed("cell of the grid on which the route is searched; larger in fields of "
                         "more than a million cells",
                         "an eighth of a vehicle width", {0.02, 1.0}, {0.05, 0.1}));
    v.Real("margin_m", margin_m,
           core::Assumed("room that the route leaves beside the rover",
                         "the rover follows the route to a few centimetres; the grid is as coarse",
                         {0.0, 2.0}, {0.02, 0.1}));
    v.Real("low_rock_m", low_rock_m,
           core::Assumed("height from which rocks are driven around where there is room; rocks "
                         "above rover.geometry.belly_clearance_m always are",
                         "the light stripe's threshold of 5 cm (Matthies 1995 sec. 6)", {0.0, 10.0},
                         {0.03, 0.13}));
  }
};

// Where a rover drives to that has not found the rock where it was told: to the corners of squares
// around the told place, one square after the other, each larger than the last by the size of the
// first.
struct LocalSearchParams {
  std::int64_t squares = 0;  // 0: none
  double spacing_m = 0.5;    // half the side of the first square, and what each later one adds

  // Returns the corners in the order of driving, in the frame of the told place: square i = 1, 2,
  // ... has its corners i spacing_m off along x and y; the rover begins where both are positive and
  // drives counter-clockwise.
  std::vector<messages::Goal> Places(const messages::Goal& told) const;

  void Visit(core::FieldVisitor& v);
};

// A rock at the goal that a drive has to find.
struct GoalRockParams {
  bool enabled = false;
  double diameter_m = 0.30;
  double height_m = 0.20;
  double recognition_m = 0.0;  // 0: never recognized
  LocalSearchParams search;

  void Visit(core::FieldVisitor& v);
};

// Waypoints; each list has one entry for every waypoint, in the order of driving.
struct WaypointParams {
  std::vector<double> x_m;  // in the world frame
  std::vector<double> y_m;

  // Returns the waypoints as places. Lists of different lengths, which Visit refuses, give as many
  // as the shorter list has.
  std::vector<messages::Goal> Places() const;

  void Visit(core::FieldVisitor& v);
};

// The course of a trial.
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
  SiteMapParams site_map;
  GoalRockParams goal_rock;

  math::Pose2 Start() const { return {start_x_m, start_y_m, start_heading_rad}; }

  // Returns the true places that the rover drives to one after the other, in W: every waypoint,
  // then the goal.
  std::vector<messages::Goal> Goals() const;

  // Returns the true goal at a simulated time: goal_x_m, goal_y_m where the target stands.
  messages::Goal GoalAt(double time_s) const;

  // Returns where the lander's cameras stand, in W; the start where start and goal are one. SightOf
  // (goal_designation.cc) is the same geometry in another order of operations.
  messages::Goal LanderPlace() const;

  // Returns the horizontal range from the lander's cameras to a place in W; 0 where start and goal
  // are one, which Visit refuses.
  double DesignationRange_m(const messages::Goal& place) const;

  // Returns the longer side of the rectangle that holds start, waypoints and goal, with the margin
  // of site_map on either side.
  double SiteMapSide_m() const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial

template <>
struct rockyard::core::EnumNames<rockyard::trial::RouteMap> {
  static constexpr std::array<std::string_view, 2> kNames{"oracle", "lander"};
};

template <>
struct rockyard::core::EnumNames<rockyard::trial::RouteUse> {
  static constexpr std::array<std::string_view, 2> kNames{"navigator", "waypoints"};
};
