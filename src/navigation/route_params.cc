#include "navigation/route_params.h"

namespace rockyard::navigation {

using core::Origin;

void RouteParams::Visit(core::FieldVisitor& v) {
  v.Real("goal_tolerance_m", goal_tolerance_m,
         {.doc = "believed distance to the goal at which the rover stops as arrived",
          .min = 0.01,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "as navigation.pathfinder.goal_tolerance_m",
          .study_low = 0.05,
          .study_high = 0.3});
  v.Real("corner_tolerance_m", corner_tolerance_m,
         {.doc = "believed distance to a corner of the route at which the next leg begins; it does "
                 "too where the corner lies behind",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "well below the margin of the route",
          .study_low = 0.02,
          .study_high = 0.1});
  v.Real("steer_interval_m", steer_interval_m,
         {.doc = "believed way between looks at the bearing of the next corner",
          .min = 0.005,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "as often as the behaviour controller, a wheel radius",
          .study_low = 0.03,
          .study_high = 0.2});
  v.Angle("heading_deadband_deg", heading_deadband_rad,
          {.doc = "bearing of the next corner below which the rover drives straight and ends a "
                  "turn in place",
           .min = 1.5,
           .max = 45.0,
           .origin = Origin::kAssumed,
           .source = "a turn cannot end more exactly than one control tick, 1.3 deg",
           .study_low = 2.0,
           .study_high = 5.0});
  v.Angle("point_turn_bearing_deg", point_turn_bearing_rad,
          {.doc = "bearing of the next corner above which the rover turns in place towards it",
           .min = 1.5,
           .max = 180.0,
           .origin = Origin::kAssumed,
           .source = "an arc would leave the route by more than its margin",
           .study_low = 10.0,
           .study_high = 30.0});
  v.Require("point_turn_bearing_deg", point_turn_bearing_rad >= heading_deadband_rad,
            "is smaller than heading_deadband_deg", "use a value from heading_deadband_deg up");
  v.Real("tight_arc_radius_m", tight_arc_radius_m,
         {.doc = "tightest turning radius on the way",
          .min = 0.1,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "as navigation.pathfinder.tight_arc_radius_m",
          .study_low = 0.5,
          .study_high = 1.0});
}

}  // namespace rockyard::navigation
