#include "localization/error_state_filter_params.h"

namespace rockyard::localization {

using core::Assumed;
using core::Published;

void PriorParams::Visit(core::FieldVisitor& v) {
  v.Real(
      "position_sd_m", position_sd_m,
      Assumed(
          "standard deviation of either coordinate of the place where operators put the rover down",
          "simulated rovers are put down where they are told", {0.0, 100.0}, {0.0, 0.02}));
  v.Angle("heading_sd_deg", heading_sd_rad,
          Assumed("the same of its heading", "simulated rovers are put down where they are told",
                  {0.0, 180.0}, {0.0, 0.4}));
  v.Angle("gyro_bias_sd_deg_per_s", gyro_bias_sd_rad_s,
          Assumed("standard deviation of the rate that the gyro reports at rest, deg/s",
                  "as sensors.gyro.bias_sd_deg_per_s", {0.0, 10.0}, {0.0, 0.01}));
  v.Real("gyro_scale_sd", gyro_scale_sd,
         Published("standard deviation of measured over true turn about 1",
                   "Matthies 1995 sec. 8: turns underestimated by about 6 %, unknown to the rover",
                   {0.0, 0.5}));
  v.Real("wheel_scale_sd", wheel_scale_sd,
         Published("standard deviation of true over believed way about 1",
                   "Matthies 1995 sec. 8: wheel slip 5 % worse than on rock-free terrain",
                   {0.0, 0.5}));
}

void DriftParams::Visit(core::FieldVisitor& v) {
  v.Real("heading_variance_deg2_per_m", heading_variance_deg2_per_m,
         Published("growth of the heading error's variance a metre at reference_speed_m_s",
                   "Matthies 1995 sec. 5", {0.0, 1e4}));
  v.Real(
      "reference_speed_m_s", reference_speed_m_s,
      Published("speed at which that growth was measured", "Matthies 1995 sec. 5", {1e-4, 10.0}));
  v.Boolean("drifts_at_rest", drifts_at_rest,
            Assumed("the heading drifts while the wheels stand, too",
                    "as sensors.gyro.accumulates_at_rest"));
  v.Angle("gyro_bias_walk_deg_per_s", gyro_bias_walk_rad_s,
          Assumed("random walk of the gyro's bias: standard deviation after a second, deg/s",
                  "the simulated bias stands still within a trial", {0.0, 1.0}, {0.0, 1e-4}));
  v.Real("distance_variance_m2_per_m", distance_variance_m2_per_m,
         Published("growth of the distance error's variance a metre", "Matthies 1995 sec. 5",
                   {0.0, 1.0}));
  v.Real(
      "scrapes_per_m", scrapes_per_m,
      Assumed("scrapes a metre that the filter reckons with, each of which makes the heading jump "
              "by scrape_jump_deg; as a growth of the heading's variance. 0: rock-free sand",
              "depends on the terrain; the paper counts none", {0.0, 100.0}, {0.0, 1.0}));
  v.Angle("scrape_jump_deg", scrape_jump_rad,
          Published("size of such a jump", "Matthies 1995 sec. 8: about 5 deg", {0.0, 90.0}));
  v.Real("height_variance_m2_per_m", height_variance_m2_per_m,
         Assumed("growth of the height error's variance a metre, beside that of the tilt",
                 "a centimetre a metre among rocks", {0.0, 1.0}, {0.0, 1e-3}));
  v.Angle(
      "tilt_sd_deg", tilt_sd_rad,
      Assumed("standard deviation of roll and pitch as accelerometers tell them, or as a rover "
              "without any takes itself to be level",
              "the filter's lag and bias of accelerometers among rocks", {0.0, 90.0}, {0.2, 5.0}));
  v.Real("tilt_length_m", tilt_length_m,
         Assumed("way over which the tilt's error has little in common with itself",
                 "a wheel's way over a small rock", {0.001, 100.0}, {0.03, 0.5}));
}

void GateParams::Visit(core::FieldVisitor& v) {
  v.Real("chance", chance,
         Assumed("share of the good measurements that is turned away; 0: all are believed",
                 "one in a thousand is hardly missed", {0.0, 0.5}, {1e-6, 0.05}));
  v.Integer("patience", patience,
            Assumed("the measurement of this number that is turned away in a row is believed, and "
                    "the filter doubts itself; 0: none ever is",
                    "three wrong ones in a row are rarer than a scrape", {0, 1000}, {2, 6}));
}

void ErrorStateFilterParams::Visit(core::FieldVisitor& v) {
  v.Group("prior", prior, "how far off things may be when a drive begins");
  v.Group("drift", drift, "how the error grows on the way");
  v.Group("gate", gate, "which measurements are believed");
  v.Choice("motion_disagreement", motion_disagreement,
           Assumed("what happens to a motion from visual odometry that the gate would reject: "
                   "doubt_wheels accepts it and assumes that wheels and gyro were wrong by the "
                   "difference; turn_away rejects it",
                   "whoever saw the motion has checked that hundreds of points agree on it; wheels "
                   "slip and a gyro that is shaken jumps (Matthies 1995 sec. 8)"));
  v.Real("stretch_m", stretch_m,
         Published("way after which the covariance is carried on, if no measurement came before",
                   "Matthies 1995 sec. 5: steps of 6.7 cm", {0.0, 10.0}));
}

}  // namespace rockyard::localization
