// The simulated clock: physics and control rates, and what on-board computing takes.
#pragma once

#include "core/fields.h"
#include "trial/compute_params.h"

namespace rockyard::trial {

// Without any of it one activity goes on at a time (Matthies 1995, section 2.1.2).
struct OverlapParams {
  bool imaging = false;
  bool computing = false;
  bool steering = false;

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Boolean(
        "imaging", imaging,
        {.doc = "images of terrain are taken while the rover drives or computes, of the place "
                "where it is then; else it stops for them. For navigators that ask for it "
                "(gestalt with continuous.cycle csod or csad); a light stripe scan always stops "
                "the rover",
         .origin = Origin::kSetting});
    v.Boolean("computing", computing,
              {.doc = "looks are computed while the rover drives or takes images; else it stops "
                      "until they are. For navigators that ask for it, as imaging",
               .origin = Origin::kSetting});
    v.Boolean(
        "steering", steering,
        {.doc = "the wheels roll while they are steered, however far, but for the change between "
                "arcs and turns in place, and the steering motors draw their power beside the "
                "drive motors; else navigation.wheel_driver.steer_while_driving_deg says when the "
                "rover stands to steer, and what is steered while it drives draws nothing",
         .origin = Origin::kSetting});
  }
};

struct ClockParams {
  double scan_time_s = 20.0;
  double scan_fixed_s = 2.0;
  double scan_speed_factor = 1.0;
  double control_rate_hz = 20.0;
  double stop_time_s = 0.05;
  ComputeParams compute;
  OverlapParams overlap;

  void Visit(core::FieldVisitor& v) {
    using core::Origin;
    v.Real("scan_time_s", scan_time_s,
           {.doc = "time of one hazard scan of the published sensor: three groups of lasers, "
                   "8085 and CCDs",
            .min = 0.0,
            .max = 3600.0,
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 6 (MFEX; Rocky 3.2 has the same computer)"});
    v.Real("scan_fixed_s", scan_fixed_s,
           {.doc = "part of it that neither fewer images nor faster imaging saves",
            .min = 0.0,
            .max = 3600.0,
            .origin = Origin::kAssumed,
            .source = "switching, exposure control and the decision; most of the time goes into "
                      "clocking out and averaging images on the 8085 (Matthies 1995 sec. 6, 8)",
            .study_low = 0.5,
            .study_high = 8.0});
    v.Require("scan_fixed_s", scan_fixed_s <= scan_time_s, "is longer than scan_time_s",
              "use a value up to scan_time_s");
    v.Real("scan_speed_factor", scan_speed_factor,
           {.doc = "how many times faster than the published sensor its images are taken and "
                   "processed",
            .min = 0.01,
            .max = 1e5,
            .origin = Origin::kSetting});
    v.Real(
        "control_rate_hz", control_rate_hz,
        {.doc = "rate of odometry and manoeuvre control; a tick takes the nearest whole number of "
                "steps of the rover",
         .min = 1.0,
         .max = 1000.0,
         .origin = Origin::kAssumed,
         .source = "0.75 cm of driving and 1.3 deg of turning in place a tick",
         .study_low = 10.0,
         .study_high = 60.0});
    v.Real(
        "stop_time_s", stop_time_s,
        {.doc =
             "time before a scan, beyond rover.drive.ramp_s in which the motors come to rest, in "
             "whole steps of the rover",
         .min = 0.0,
         .max = 10.0,
         .origin = Origin::kAssumed,
         .source = "one control tick, in which the body comes to rest behind its wheels",
         .study_low = 0.05,
         .study_high = 0.5});
    v.Group("compute", compute, "what stereo and navigation take");
    v.Group("overlap", overlap,
            "what goes on while the rover drives; with none of it one activity at a time "
            "(Matthies 1995 sec. 2.1.2)");
  }
};

}  // namespace rockyard::trial
