#include "navigation/gestalt/speed_law_params.h"

namespace rockyard::navigation {

using core::Origin;

void SpeedLawParams::Visit(core::FieldVisitor& v) {
  v.Real("full_speed_curvature_per_m", full_speed_curvature_per_m,
         {.doc = "curvature up to which the rover drives at full speed",
          .min = 0.0,
          .max = 20.0,
          .origin = Origin::kAssumed,
          .source = "Howard 2012 sec. 3: speed \"is reduced only for high-curvature maneuvers\"; "
                    "half of the largest knot, where the outer wheels have to be a fifth faster "
                    "than the rover's centre",
          .study_low = 0.25,
          .study_high = 0.9});
  v.Real("slow_curvature_per_m", slow_curvature_per_m,
         {.doc = "curvature from which the rover drives at min_speed_share; between the two the "
                 "share is linear in the curvature",
          .min = 0.001,
          .max = 20.0,
          .origin = Origin::kAssumed,
          .source = "the largest knot of Howard 2012 sec. 3",
          .study_low = 1.0,
          .study_high = 2.0});
  v.Require("slow_curvature_per_m", slow_curvature_per_m > full_speed_curvature_per_m,
            "is not larger than full_speed_curvature_per_m, so that there is no curvature between "
            "the two over which the rover could slow down",
            "use a larger slow_curvature_per_m or a smaller full_speed_curvature_per_m");
  v.Real("min_speed_share", min_speed_share,
         {.doc = "share of the full speed in the tightest curves; 1 never slows down",
          .min = 0.05,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "Howard 2012 names none; half speed gives the steering motors twice the time "
                    "for the same path",
          .study_low = 0.25,
          .study_high = 1.0});
}

}  // namespace rockyard::navigation
