// Parameters of RouteFollower: how a rover follows a route that it was given. A default decides the
// records of scenarios that leave it out; a bound only refuses files.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::navigation {

struct RouteParams {
  double goal_tolerance_m = 0.10;
  double corner_tolerance_m = 0.05;
  double steer_interval_m = 0.065;
  double heading_deadband_rad = math::DegToRad(2.0);
  double point_turn_bearing_rad = math::DegToRad(15.0);
  double tight_arc_radius_m = 0.75;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation
