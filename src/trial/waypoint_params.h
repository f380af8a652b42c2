// Intermediate places of a course.
#pragma once

#include <vector>

#include "core/fields.h"
#include "messages/estimates.h"

namespace rockyard::trial {

// Each list has one entry for every waypoint, in the order in which the rover drives to them.
struct WaypointParams {
  std::vector<double> x_m;  // in the world frame
  std::vector<double> y_m;

  // The waypoints as places. Lists of different lengths, which Visit refuses, give as many as the
  // shorter one has.
  std::vector<messages::Goal> Places() const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial
