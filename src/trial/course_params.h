// Where a trial starts, where it leads, and how near counts as there.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/fields.h"
#include "trial/designation_params.h"
#include "trial/route_plan_params.h"

namespace rockyard::trial {

struct CourseParams {
  double start_x_m = 0.0;
  double start_y_m = 0.0;
  double start_heading_rad = 0.0;
  double goal_x_m = 7.6;
  double goal_y_m = 0.0;
  double goal_radius_m = 0.65;
  std::int64_t trials_per_layout = 1;
  DesignationParams designation;
  RoutePlanParams oracle_route;

  // From the lander's cameras to the goal.
  double DesignationRange_m() const {
    const double straight_m = std::hypot(goal_x_m - start_x_m, goal_y_m - start_y_m);
    return std::hypot(straight_m - designation.lander_ahead_m, designation.lander_left_m);
  }

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Real("start_x_m", start_x_m,
           {.doc = "start position", .min = -1000.0, .max = 1000.0, .origin = Origin::kSetting});
    v.Real("start_y_m", start_y_m,
           {.doc = "start position", .min = -1000.0, .max = 1000.0, .origin = Origin::kSetting});
    v.Angle("start_heading_deg", start_heading_rad,
            {.doc = "start heading, from +x towards +y",
             .min = -180.0,
             .max = 180.0,
             .origin = Origin::kSetting});
    v.Real("goal_x_m", goal_x_m,
           {.doc = "goal position",
            .min = -1000.0,
            .max = 1000.0,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 7: 7.6 m from the start"});
    v.Real("goal_y_m", goal_y_m,
           {.doc = "goal position", .min = -1000.0, .max = 1000.0, .origin = Origin::kSetting});
    v.Real("goal_radius_m", goal_radius_m,
           {.doc = "true distance to the goal within which a declared arrival is true: about one "
                   "vehicle length, from where the rover recognises its target",
            .min = 0.01,
            .max = 100.0,
            .origin = Origin::kAssumed,
            .source = "about one vehicle length, from where the rover recognises prominent rocks "
                      "(Matthies 1995 sec. 8)",
            .study_low = 0.3,
            .study_high = 1.5});
    v.Integer("trials_per_layout", trials_per_layout,
              {.doc = "consecutive trials that meet the same rock field; the paper does not say "
                      "whether the runs of a set did",
               .min = 1,
               .max = 1e6,
               .origin = Origin::kSetting});
    v.Group("designation", designation, "the goal that the rover is told");
    v.Group("oracle_route", oracle_route,
            "how the route is planned that navigation.navigator route follows");
    const double dx = goal_x_m - start_x_m;
    const double dy = goal_y_m - start_y_m;
    v.Require("goal_x_m", dx * dx + dy * dy > 0.01, "puts the goal within 0.1 m of the start",
              "use a goal that the rover has to drive to, e.g. 7.6");
  }
};

}  // namespace rockyard::trial
