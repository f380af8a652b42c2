#include "perception/visual_motion_params.h"

namespace rockyard::perception {

using core::Assumed;
using core::Setting;

void SlipCheckParams::Visit(core::FieldVisitor& v) {
  v.Boolean(
      "enabled", enabled,
      Setting("the way of the wheels is compared with the way that visual odometry saw; beyond the "
              "limit an alarm is raised, and navigation.on_slip says what follows"));
  v.Real("limit", limit,
         Assumed("slip that is too much: 1 less the seen way over the rolled way",
                 "Howard 2012 has slip checking without a number; half of the way lost is more "
                 "than any slope that a rover is sent up",
                 {-1.0, 1.0}, {0.2, 0.8}));
  v.Real("sigma", sigma,
         Assumed("standard deviations of the measured slip by which the limit is to be exceeded",
                 "a stop without reason costs a day of operations", {0.0, 100.0}, {0.0, 4.0}));
  v.Real(
      "min_way_m", min_way_m,
      Assumed(
          "way of the wheels, from the keyframe to the newest images, from which on slip is told",
          "three steps of 6.7 cm (Matthies 1995 sec. 5)", {1e-3, 100.0}, {0.05, 0.75}));
}

void VisualMotionParams::Visit(core::FieldVisitor& v) {
  v.Angle("tilt_sd_deg", tilt_sd_rad,
          Assumed("standard deviation of roll and of pitch, as the rover believes them, where a "
                  "motion is told in the levelled frame",
                  "as localization.error_state.drift.tilt_sd_deg: vibration and the rover's own "
                  "accelerations",
                  {0.0, 90.0}, {0.1, 3.0}));
  v.Group("slip_check", slip_check, "whether the wheels slip more than the rover should stand");
  odometer.Visit(v);
}

}  // namespace rockyard::perception
