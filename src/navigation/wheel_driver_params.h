// Parameters of the wheel driver.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::navigation {

// The values that WheelDriver asks for.
struct WheelDriverParams {
  double steer_rate_rad_s = math::DegToRad(60.0);
  double steer_while_driving_rad = math::DegToRad(10.0);

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Angle("steer_rate_deg_s", steer_rate_rad_s,
            {.doc = "believed rate of the steering motors",
             .min = 1.0,
             .max = 1000.0,
             .origin = Origin::kAssumed,
             .source = "as the rate of the steering motors",
             .study_low = 20.0,
             .study_high = 90.0});
    v.Angle("steer_while_driving_deg", steer_while_driving_rad,
            {.doc = "largest steering change made while driving; larger ones are made at rest",
             .min = 0.0,
             .max = 180.0,
             .origin = Origin::kAssumed,
             .source = "changes between neighbouring arcs; the power budget allows one major "
                       "function at a time",
             .study_low = 5.0,
             .study_high = 20.0});
  }
};

}  // namespace rockyard::navigation
