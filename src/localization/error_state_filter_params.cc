#include "localization/error_state_filter_params.h"

namespace rockyard::localization {

using core::Origin;

void PriorParams::Visit(core::FieldVisitor& v) {
  v.Real("position_sd_m", position_sd_m,
         {.doc = "standard deviation of either coordinate of the place where operators put the "
                 "rover down",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "simulated rovers are put down where they are told",
          .study_low = 0.0,
          .study_high = 0.02});
  v.Angle("heading_sd_deg", heading_sd_rad,
          {.doc = "the same of its heading",
           .min = 0.0,
           .max = 180.0,
           .origin = Origin::kAssumed,
           .source = "simulated rovers are put down where they are told",
           .study_low = 0.0,
           .study_high = 0.4});
  v.Angle("gyro_bias_sd_deg_per_s", gyro_bias_sd_rad_s,
          {.doc = "standard deviation of the rate that the gyro reports at rest, deg/s",
           .min = 0.0,
           .max = 10.0,
           .origin = Origin::kAssumed,
           .source = "as sensors.gyro.bias_sd_deg_per_s",
           .study_low = 0.0,
           .study_high = 0.01});
  v.Real(
      "gyro_scale_sd", gyro_scale_sd,
      {.doc = "standard deviation of measured over true turn about 1",
       .min = 0.0,
       .max = 0.5,
       .origin = Origin::kPublished,
       .source = "Matthies 1995 sec. 8: turns underestimated by about 6 %, unknown to the rover"});
  v.Real("wheel_scale_sd", wheel_scale_sd,
         {.doc = "standard deviation of true over believed way about 1",
          .min = 0.0,
          .max = 0.5,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 8: wheel slip 5 % worse than on rock-free terrain"});
}

void DriftParams::Visit(core::FieldVisitor& v) {
  v.Real("heading_variance_deg2_per_m", heading_variance_deg2_per_m,
         {.doc = "growth of the heading error's variance a metre at reference_speed_m_s",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5"});
  v.Real("reference_speed_m_s", reference_speed_m_s,
         {.doc = "speed at which that growth was measured",
          .min = 1e-4,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5"});
  v.Boolean("drifts_at_rest", drifts_at_rest,
            {.doc = "the heading drifts while the wheels stand, too",
             .origin = Origin::kAssumed,
             .source = "as sensors.gyro.accumulates_at_rest"});
  v.Angle("gyro_bias_walk_deg_per_s", gyro_bias_walk_rad_s,
          {.doc = "random walk of the gyro's bias: standard deviation after a second, deg/s",
           .min = 0.0,
           .max = 1.0,
           .origin = Origin::kAssumed,
           .source = "the simulated bias stands still within a trial",
           .study_low = 0.0,
           .study_high = 1e-4});
  v.Real("distance_variance_m2_per_m", distance_variance_m2_per_m,
         {.doc = "growth of the distance error's variance a metre",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5"});
  v.Real(
      "scrapes_per_m", scrapes_per_m,
      {.doc = "scrapes a metre that the filter reckons with, each of which makes the heading "
              "jump by scrape_jump_deg; as a growth of the heading's variance. 0: rock-free sand",
       .min = 0.0,
       .max = 100.0,
       .origin = Origin::kAssumed,
       .source = "depends on the terrain; the paper counts none",
       .study_low = 0.0,
       .study_high = 1.0});
  v.Angle("scrape_jump_deg", scrape_jump_rad,
          {.doc = "size of such a jump",
           .min = 0.0,
           .max = 90.0,
           .origin = Origin::kPublished,
           .source = "Matthies 1995 sec. 8: about 5 deg"});
  v.Real("height_variance_m2_per_m", height_variance_m2_per_m,
         {.doc = "growth of the height error's variance a metre, beside that of the tilt",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "a centimetre a metre among rocks",
          .study_low = 0.0,
          .study_high = 1e-3});
  v.Angle("tilt_sd_deg", tilt_sd_rad,
          {.doc = "standard deviation of roll and pitch as accelerometers tell them, or as a rover "
                  "without any takes itself to be level",
           .min = 0.0,
           .max = 90.0,
           .origin = Origin::kAssumed,
           .source = "the filter's lag and bias of accelerometers among rocks",
           .study_low = 0.2,
           .study_high = 5.0});
  v.Real("tilt_length_m", tilt_length_m,
         {.doc = "way over which the tilt's error has little in common with itself",
          .min = 0.001,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "a wheel's way over a small rock",
          .study_low = 0.03,
          .study_high = 0.5});
}

void GateParams::Visit(core::FieldVisitor& v) {
  v.Real("chance", chance,
         {.doc = "share of the good measurements that is turned away; 0: all are believed",
          .min = 0.0,
          .max = 0.5,
          .origin = Origin::kAssumed,
          .source = "one in a thousand is hardly missed",
          .study_low = 1e-6,
          .study_high = 0.05});
  v.Integer("patience", patience,
            {.doc = "the measurement of this number that is turned away in a row is believed, and "
                    "the filter doubts itself; 0: none ever is",
             .min = 0,
             .max = 1000,
             .origin = Origin::kAssumed,
             .source = "three wrong ones in a row are rarer than a scrape",
             .study_low = 2,
             .study_high = 6});
}

void ErrorStateFilterParams::Visit(core::FieldVisitor& v) {
  v.Group("prior", prior, "how far off things may be when a drive begins");
  v.Group("drift", drift, "how the error grows on the way");
  v.Group("gate", gate, "which measurements are believed");
  v.Choice("motion_disagreement", motion_disagreement,
           {.doc = "what becomes of a motion between two moments (visual odometry) that the gate "
                   "would turn away: doubt_wheels takes it, and takes wheels and gyro to have gone "
                   "wrong in between by as much as it says; turn_away does not",
            .origin = Origin::kAssumed,
            .source = "whoever saw the motion has checked that hundreds of points agree on it; "
                      "wheels slip and a gyro that is shaken jumps (Matthies 1995 sec. 8)"});
  v.Real("stretch_m", stretch_m,
         {.doc = "way after which the covariance is carried on, if no measurement came before",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5: steps of 6.7 cm"});
}

}  // namespace rockyard::localization
