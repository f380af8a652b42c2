// Parameters of the overhead tracking cameras of the test arena (sensors.tracker), and of the
// sensor that follows a feature which the rover is to drive to (course.tracking). The sensors of
// tracker.h read them; the trial keeps the period. Where enabled, defaults decide records.
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
    constexpr std::string_view kSection3 = "Matthies 1995 sec. 3";
    v.Boolean("enabled", enabled,
              core::Setting("report errors against the tracked instead of the true pose"));
    v.Real("systematic_position_m", systematic_position_m,
           core::Published("largest systematic position error", kSection3, {0.0, 1.0}));
    v.Angle("systematic_heading_deg", systematic_heading_rad,
            core::Published("largest systematic heading error", kSection3, {0.0, 90.0}));
    v.Real("random_position_m", random_position_m,
           core::Published("root mean square of the random position error", kSection3, {0.0, 1.0}));
    v.Angle(
        "random_heading_deg", random_heading_rad,
        core::Published("root mean square of the random heading error", kSection3, {0.0, 90.0}));
  }
};

struct FeatureTrackerParams {
  bool enabled = false;
  double range_m = 5.0;
  double half_field_of_view_rad = math::DegToRad(45.0);
  double bearing_sd_rad = math::DegToRad(0.5);
  double range_sd_fraction = 0.02;
  double period_s = 1.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing
