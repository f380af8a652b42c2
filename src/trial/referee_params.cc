#include "trial/referee_params.h"

namespace rockyard::trial {
namespace {

using core::Origin;

void VisitStuck(RefereeParams& p, core::FieldVisitor& v) {
  v.Choice("stuck_rover", p.stuck_rover,
           {.doc = "what becomes of a rover that is found stuck: its run ends, or it drains its "
                   "batteries and the time and energy of that count, in closed form",
            .origin = Origin::kAssumed,
            .source = "operators see a rover that stands still; one run of Matthies 1995 sec. 7, "
                      "jammed between two rocks, went on until its batteries were empty"});
  v.Choice("spinning_wheels", p.spinning_wheels,
           {.doc = "whether wheels that spin without moving the rover count as motion",
            .origin = Origin::kAssumed,
            .source = "operators see a rover that stands still; the paper does not say when they "
                      "stopped one"});
  v.Real("stall_window_s", p.stall_window_s,
         {.doc = "time of commanded motion without any after which the rover is stuck; scans do "
                 "not count",
          .min = 1.0,
          .max = 3600.0,
          .origin = Origin::kAssumed,
          .source = "1.5 m of commanded driving at 15 cm/s, spread over ten minutes of scans",
          .study_low = 5.0,
          .study_high = 60.0});
  v.Real("stall_distance_m", p.stall_distance_m,
         {.doc = "true displacement, net or the way it was told, below which there is no motion in "
                 "the window",
          .min = 1e-4,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "a third of a wheel radius, above the jitter of spinning wheels",
          .study_low = 0.01,
          .study_high = 0.05});
  v.Angle("stall_turn_deg", p.stall_turn_rad,
          {.doc = "true rotation, net or the way it was told, below which there is no motion in "
                  "the window",
           .min = 0.1,
           .max = 90.0,
           .origin = Origin::kAssumed,
           .source = "half of the default turn increment",
           .study_low = 3.0,
           .study_high = 10.0});
  v.Real("high_centre_time_share", p.high_centre_time_share,
         {.doc = "share of the window in which the belly rests on a rock that makes a stuck rover "
                 "high-centred rather than jammed",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "the belly may lift off for moments while the wheels dig",
          .study_low = 0.1,
          .study_high = 0.5});
}

void VisitPatience(RefereeParams& p, core::FieldVisitor& v) {
  v.Real(
      "no_path_progress_m", p.no_path_progress_m,
      {.doc = "gain in the believed distance to the goal, with as much true displacement, that "
              "counts as progress for the operator; left open (null): half of the rover's width, "
              "0.25 at least",
       .min = 0.01,
       .max = 100.0,
       .origin = Origin::kAssumed,
       .source = "half a vehicle width",
       .study_low = 0.1,
       .study_high = 0.5});
  v.Real("no_path_distance_m", p.no_path_distance_m,
         {.doc = "true distance driven without progress after which the operator ends the run; 0: "
                 "however far; left open (null): half of the course, 4 at least",
          .min = 0.0,
          .max = 1e5,
          .origin = Origin::kAssumed,
          .source = "half of the course once more without coming nearer",
          .study_low = 2.0,
          .study_high = 10.0});
  v.Angle("no_path_turn_deg", p.no_path_turn_rad,
          {.doc = "turning in place without progress after which the operator ends the run; 0: "
                  "however much",
           .min = 0.0,
           .max = 1e5,
           .origin = Origin::kAssumed,
           .source = "three full turns",
           .study_low = 720.0,
           .study_high = 2160.0});
  v.Real("no_path_time_s", p.no_path_time_s,
         {.doc = "simulated time without progress after which the operator ends the run; 0: "
                 "however long; left open (null): 900 s for each metre of half of the course, 3600 "
                 "at least",
          .min = 0.0,
          .max = 1e7,
          .origin = Origin::kSetting,
          .source = "whether a clock ends runs; by default 180 scans without coming nearer by half "
                    "a vehicle width"});
}

}  // namespace

void RefereeParams::Visit(core::FieldVisitor& v) {
  v.Angle(
      "tip_over_deg", tip_over_rad,
      {.doc = "tilt of the chassis at which the rover has tipped over",
       .min = 20.0,
       .max = 120.0,
       .origin = Origin::kAssumed,
       .source =
           "beyond the static tipping angles of Rocky 3.2, whose centre of mass is 0.17 m high: 50 "
           "to "
           "55 deg sideways (wheels from 0.20 to 0.24 m beside it), 57 deg over an axle (0.26 m)",
       .study_low = 50.0,
       .study_high = 80.0});
  VisitStuck(*this, v);
  VisitPatience(*this, v);
  v.Real("time_limit_s", time_limit_s,
         {.doc = "simulated time after which the run is stopped; 0: never; left open (null): four "
                 "hours for each 7.6 m of the course, four at least",
          .min = 0.0,
          .max = 1e7,
          .origin = Origin::kSetting,
          .source = "whether a clock ends runs; by default the four hours of a day of the MFEX "
                    "rover, Matthies 1995 sec. 2.1.2"});
  v.Real("hazard_height_m", hazard_height_m,
         {.doc = "height from which a rock counts in hazards_met and hazards_missed; decides "
                 "nothing in the drive",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "the clearance of the undercarriage, Matthies 1995 sec. 6",
          .study_low = 0.075,
          .study_high = 0.15});
}

}  // namespace rockyard::trial
