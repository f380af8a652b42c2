#include "navigation/route_params.h"

namespace rockyard::navigation {

using core::Assumed;

void RouteParams::Visit(core::FieldVisitor& v) {
  v.Real("goal_tolerance_m", goal_tolerance_m,
         Assumed("believed distance to the goal at which the rover stops as arrived",
                 "as navigation.pathfinder.goal_tolerance_m", {0.01, 10.0}, {0.05, 0.3}));
  v.Real("corner_tolerance_m", corner_tolerance_m,
         Assumed("believed distance to a corner of the route at which the next leg begins; it does "
                 "too where the corner lies behind",
                 "well below the margin of the route", {0.001, 10.0}, {0.02, 0.1}));
  v.Real(
      "steer_interval_m", steer_interval_m,
      Assumed("believed way between looks at the bearing of the next corner",
              "as often as the behaviour controller, a wheel radius", {0.005, 10.0}, {0.03, 0.2}));
  v.Angle("heading_deadband_deg", heading_deadband_rad,
          Assumed("bearing of the next corner below which the rover drives straight and ends a "
                  "turn in place",
                  "a turn cannot end more exactly than one control tick, 1.3 deg", {1.5, 45.0},
                  {2.0, 5.0}));
  v.Angle(
      "point_turn_bearing_deg", point_turn_bearing_rad,
      Assumed("bearing of the next corner above which the rover turns in place towards it",
              "an arc would leave the route by more than its margin", {1.5, 180.0}, {10.0, 30.0}));
  v.Require("point_turn_bearing_deg", point_turn_bearing_rad >= heading_deadband_rad,
            "is smaller than heading_deadband_deg", "use a value from heading_deadband_deg up");
  v.Real("tight_arc_radius_m", tight_arc_radius_m,
         Assumed("tightest turning radius on the way",
                 "as navigation.pathfinder.tight_arc_radius_m", {0.1, 100.0}, {0.5, 1.0}));
}

}  // namespace rockyard::navigation
