#include "trial/waypoint_params.h"

#include <algorithm>
#include <cstddef>

namespace rockyard::trial {

using core::Origin;

std::vector<messages::Goal> WaypointParams::Places() const {
  std::vector<messages::Goal> places;
  for (std::size_t i = 0; i < std::min(x_m.size(), y_m.size()); ++i) {
    places.push_back({x_m[i], y_m[i]});
  }
  return places;
}

void WaypointParams::Visit(core::FieldVisitor& v) {
  v.Reals("x_m", x_m,
          {.doc = "x of every waypoint, in the order of driving; none leads straight to the goal",
           .min = -1000.0,
           .max = 1000.0,
           .origin = Origin::kSetting});
  v.Reals(
      "y_m", y_m,
      {.doc = "y of every waypoint", .min = -1000.0, .max = 1000.0, .origin = Origin::kSetting});
  v.Require("x_m", x_m.size() == y_m.size(), "names another number of waypoints than y_m",
            "give every waypoint one entry of each list");
}

}  // namespace rockyard::trial
