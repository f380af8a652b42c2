#include "perception/visual_motion_params.h"

namespace rockyard::perception {

void VisualMotionParams::Visit(core::FieldVisitor& v) {
  v.Angle("tilt_sd_deg", tilt_sd_rad,
          {.doc = "standard deviation of roll and of pitch, as the rover believes them, where a "
                  "motion is told in the levelled frame",
           .min = 0.0,
           .max = 90.0,
           .origin = core::Origin::kAssumed,
           .source = "as localization.error_state.drift.tilt_sd_deg: vibration and the rover's own "
                     "accelerations",
           .study_low = 0.1,
           .study_high = 3.0});
  v.Group("slip_check", slip_check, "whether the wheels slip more than the rover should stand");
  odometer.Visit(v);
}

}  // namespace rockyard::perception
