// Parameters of WheelDriver. They hold what the rover believes of its steering motors; their true
// rate is that of rover.drive. A default decides the records of scenarios that leave it out; a
// bound only refuses files.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::navigation {

struct WheelDriverParams {
  double steer_rate_rad_s = math::DegToRad(60.0);
  double steer_while_driving_rad = math::DegToRad(10.0);

  void Visit(core::FieldVisitor& v) {
    v.Angle("steer_rate_deg_s", steer_rate_rad_s,
            core::Assumed("believed rate of the steering motors",
                          "as the rate of the steering motors", {1.0, 1000.0}, {20.0, 90.0}));
    v.Angle(
        "steer_while_driving_deg", steer_while_driving_rad,
        core::Assumed("largest steering change made while driving; larger ones are made at rest",
                      "changes between neighbouring arcs; the power budget allows one major "
                      "function at a time",
                      {0.0, 180.0}, {5.0, 20.0}));
  }
};

}  // namespace rockyard::navigation
