// Parameters of the overhead tracking cameras of the test arena.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::sensing {

struct TrackerParams {
  bool enabled = false;
  double systematic_position_m = 0.02;
  double systematic_heading_rad = math::DegToRad(0.4);
  double random_position_m = 0.0003;
  double random_heading_rad = math::DegToRad(0.2);

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    constexpr std::string_view kSection3 = "Matthies 1995 sec. 3";
    v.Boolean("enabled", enabled,
              {.doc = "report errors against the tracked instead of the true pose",
               .origin = Origin::kSetting});
    v.Real("systematic_position_m", systematic_position_m,
           {.doc = "largest systematic position error",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kPublished,
            .source = kSection3});
    v.Angle("systematic_heading_deg", systematic_heading_rad,
            {.doc = "largest systematic heading error",
             .min = 0.0,
             .max = 90.0,
             .origin = Origin::kPublished,
             .source = kSection3});
    v.Real("random_position_m", random_position_m,
           {.doc = "root mean square of the random position error",
            .min = 0.0,
            .max = 1.0,
            .origin = Origin::kPublished,
            .source = kSection3});
    v.Angle("random_heading_deg", random_heading_rad,
            {.doc = "root mean square of the random heading error",
             .min = 0.0,
             .max = 90.0,
             .origin = Origin::kPublished,
             .source = kSection3});
  }
};

}  // namespace rockyard::sensing
