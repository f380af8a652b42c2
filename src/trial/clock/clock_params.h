// The simulated clock: control rate, what scans, stops and on-board computing take, and what may go
// on at once. The loop of a drive, its timeline and the times of looks go by it. Records depend on
// a default in every scenario that leaves its parameter out; a bound only refuses files.
#pragma once

#include "core/fields.h"
#include "trial/clock/compute_params.h"

namespace rockyard::trial {

// What may go on beside the drive; with nothing of it one activity goes on at a time (Matthies
// 1995, section 2.1.2).
struct OverlapParams {
  bool imaging = false;
  bool computing = false;
  bool steering = false;

  void Visit(core::FieldVisitor& v) {
    v.Boolean(
        "imaging", imaging,
        core::Setting(
            "images of terrain are taken while the rover drives or computes, of the place where it "
            "is then; else it stops for them. For navigators that ask for it (gestalt with "
            "continuous.cycle csod or csad); a light stripe scan always stops the rover"));
    v.Boolean("computing", computing,
              core::Setting("looks are computed while the rover drives or takes images; else it "
                            "stops until they are. For navigators that ask for it, as imaging"));
    v.Boolean("steering", steering,
              core::Setting(
                  "the wheels roll while they are steered, however far, but for the change between "
                  "arcs and turns in place, and the steering motors draw their power beside the "
                  "drive motors; else navigation.wheel_driver.steer_while_driving_deg says when "
                  "the rover stands to steer, and what is steered while it drives draws nothing"));
  }
};

// Rates and times of the clock.
struct ClockParams {
  double scan_time_s = 20.0;
  double scan_fixed_s = 2.0;
  double scan_speed_factor = 1.0;
  double control_rate_hz = 20.0;
  double stop_time_s = 0.05;
  ComputeParams compute;
  OverlapParams overlap;

  void Visit(core::FieldVisitor& v) {
    v.Real("scan_time_s", scan_time_s,
           core::Published("time of one hazard scan of the published sensor: three groups of "
                           "lasers, 8085 and CCDs",
                           "Matthies 1995 sec. 6 (MFEX; Rocky 3.2 has the same computer)",
                           {0.0, 3600.0}));
    v.Real("scan_fixed_s", scan_fixed_s,
           core::Assumed("part of it that neither fewer images nor faster imaging saves",
                         "switching, exposure control and the decision; most of the time goes into "
                         "clocking out and averaging images on the 8085 (Matthies 1995 sec. 6, 8)",
                         {0.0, 3600.0}, {0.5, 8.0}));
    v.Require("scan_fixed_s", scan_fixed_s <= scan_time_s, "is longer than scan_time_s",
              "use a value up to scan_time_s");
    v.Real("scan_speed_factor", scan_speed_factor,
           core::Setting(
               "how many times faster than the published sensor its images are taken and processed",
               {0.01, 1e5}));
    v.Real("control_rate_hz", control_rate_hz,
           core::Assumed("rate of odometry and manoeuvre control; a tick takes the nearest whole "
                         "number of steps of the rover",
                         "0.75 cm of driving and 1.3 deg of turning in place a tick", {1.0, 1000.0},
                         {10.0, 60.0}));
    v.Real("stop_time_s", stop_time_s,
           core::Assumed("time before a scan, beyond rover.drive.ramp_s in which the motors come "
                         "to rest, in whole steps of the rover",
                         "one control tick, in which the body comes to rest behind its wheels",
                         {0.0, 10.0}, {0.05, 0.5}));
    v.Group("compute", compute, "what stereo and navigation take");
    v.Group("overlap", overlap,
            "what goes on while the rover drives; with none of it one activity at a time "
            "(Matthies 1995 sec. 2.1.2)");
  }
};

}  // namespace rockyard::trial
