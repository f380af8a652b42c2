#include "rover/quasi_static/quasi_static_params.h"

namespace rockyard::rover {

using core::Origin;

void QuasiStaticParams::Visit(core::FieldVisitor& v) {
  v.Real("step_s", step_s,
         {.doc = "time of one step", .min = 1e-3, .max = 1.0, .origin = Origin::kSetting});
  v.Real("settle_distance_m", settle_distance_m,
         {.doc = "way between two poses that are settled on the terrain; interpolated between",
          .min = 1e-3,
          .max = 0.1,
          .origin = Origin::kSetting});
  v.Angle("settle_turn_deg", settle_turn_rad,
          {.doc = "turn between two settled poses",
           .min = 0.1,
           .max = 15.0,
           .origin = Origin::kSetting});
  v.Real("rock_settle_share", rock_settle_share,
         {.doc = "share of both while a rock or a wall bears a part of the rover",
          .min = 0.05,
          .max = 1.0,
          .origin = Origin::kSetting});
}

}  // namespace rockyard::rover
