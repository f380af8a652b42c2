// How an oracle plans a route for a rover that is to need no path selection of its own.
#pragma once

#include "core/fields.h"

namespace rockyard::trial {

struct RoutePlanParams {
  double cell_m = 0.05;
  double margin_m = 0.05;
  double low_rock_m = 0.05;

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Real("cell_m", cell_m,
           {.doc = "cell of the grid on which the route is searched; larger in fields of more than "
                   "a million cells",
            .min = 0.02,
            .max = 1.0,
            .origin = Origin::kAssumed,
            .source = "an eighth of a vehicle width",
            .study_low = 0.05,
            .study_high = 0.1});
    v.Real("margin_m", margin_m,
           {.doc = "room that the route leaves beside the rover",
            .min = 0.0,
            .max = 2.0,
            .origin = Origin::kAssumed,
            .source = "the rover follows the route to a few centimetres; the grid is as coarse",
            .study_low = 0.02,
            .study_high = 0.1});
    v.Real("low_rock_m", low_rock_m,
           {.doc = "height from which rocks are driven around where there is room; rocks above "
                   "rover.geometry.belly_clearance_m always are",
            .min = 0.0,
            .max = 10.0,
            .origin = Origin::kAssumed,
            .source = "the light stripe's threshold of 5 cm (Matthies 1995 sec. 6)",
            .study_low = 0.03,
            .study_high = 0.13});
  }
};

}  // namespace rockyard::trial
