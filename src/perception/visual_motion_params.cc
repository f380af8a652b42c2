#include "perception/visual_motion_params.h"

namespace rockyard::perception {

void SlipCheckParams::Visit(core::FieldVisitor& v) {
  using core::Origin;
  v.Boolean(
      "enabled", enabled,
      {.doc = "the way of the wheels is compared with the way that visual odometry saw; beyond "
              "the limit an alarm is raised, and navigation.on_slip says what follows",
       .origin = Origin::kSetting});
  v.Real("limit", limit,
         {.doc = "slip that is too much: 1 less the seen way over the rolled way",
          .min = -1.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "Howard 2012 has slip checking without a number; half of the way lost is more "
                    "than any slope that a rover is sent up",
          .study_low = 0.2,
          .study_high = 0.8});
  v.Real("sigma", sigma,
         {.doc = "standard deviations of the measured slip by which the limit is to be exceeded",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "a stop without reason costs a day of operations",
          .study_low = 0.0,
          .study_high = 4.0});
  v.Real("min_way_m", min_way_m,
         {.doc = "way of the wheels, from the keyframe to the newest images, from which on slip is "
                 "told",
          .min = 1e-3,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "three steps of 6.7 cm (Matthies 1995 sec. 5)",
          .study_low = 0.05,
          .study_high = 0.75});
}

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
