#include "trial/referee/referee_params.h"

namespace rockyard::trial {
namespace {

using core::Assumed;
using core::Setting;

void VisitStuck(RefereeParams& p, core::FieldVisitor& v) {
  v.Choice("stuck_rover", p.stuck_rover,
           Assumed("what becomes of a rover that is found stuck: its run ends, or it drains its "
                   "batteries and the time and energy of that count, in closed form",
                   "operators see a rover that stands still; one run of Matthies 1995 sec. 7, "
                   "jammed between two rocks, went on until its batteries were empty"));
  v.Choice(
      "spinning_wheels", p.spinning_wheels,
      Assumed(
          "whether wheels that spin without moving the rover count as motion",
          "operators see a rover that stands still; the paper does not say when they stopped one"));
  v.Real(
      "stall_window_s", p.stall_window_s,
      Assumed(
          "time of commanded motion without any after which the rover is stuck; scans do not count",
          "1.5 m of commanded driving at 15 cm/s, spread over ten minutes of scans", {1.0, 3600.0},
          {5.0, 60.0}));
  v.Real("stall_distance_m", p.stall_distance_m,
         Assumed("true displacement, net or the way it was told, below which there is no motion in "
                 "the window",
                 "a third of a wheel radius, above the jitter of spinning wheels", {1e-4, 1.0},
                 {0.01, 0.05}));
  v.Angle(
      "stall_turn_deg", p.stall_turn_rad,
      Assumed(
          "true rotation, net or the way it was told, below which there is no motion in the window",
          "half of the default turn increment", {0.1, 90.0}, {3.0, 10.0}));
  v.Real(
      "high_centre_time_share", p.high_centre_time_share,
      Assumed("share of the window in which the belly rests on a rock that makes a stuck rover "
              "high-centred rather than jammed",
              "the belly may lift off for moments while the wheels dig", {0.0, 1.0}, {0.1, 0.5}));
}

void VisitPatience(RefereeParams& p, core::FieldVisitor& v) {
  v.Real("no_path_progress_m", p.no_path_progress_m,
         Assumed("gain in the believed distance to the goal, with as much true displacement, that "
                 "counts as progress for the operator; left open (null): half of the rover's "
                 "width, 0.25 at least",
                 "half a vehicle width", {0.01, 100.0}, {0.1, 0.5}));
  v.Real("no_path_distance_m", p.no_path_distance_m,
         Assumed("true distance driven without progress after which the operator ends the run; 0: "
                 "however far; left open (null): half of the course, 4 at least",
                 "half of the course once more without coming nearer", {0.0, 1e5}, {2.0, 10.0}));
  v.Angle("no_path_turn_deg", p.no_path_turn_rad,
          Assumed("turning in place without progress after which the operator ends the run; 0: "
                  "however much",
                  "three full turns", {0.0, 1e5}, {720.0, 2160.0}));
  v.Real(
      "no_path_time_s", p.no_path_time_s,
      Setting("simulated time without progress after which the operator ends the run; 0: however "
              "long; left open (null): 900 s for each metre of half of the course, 3600 at least",
              {0.0, 1e7},
              "whether a clock ends runs; by default 180 scans without coming nearer by half a "
              "vehicle width"));
}

}  // namespace

void RefereeParams::Visit(core::FieldVisitor& v) {
  v.Angle(
      "tip_over_deg", tip_over_rad,
      Assumed(
          "tilt of the chassis at which the rover has tipped over",
          "beyond the static tipping angles of Rocky 3.2, whose centre of mass is 0.17 m high: 50 "
          "to 55 deg sideways (wheels from 0.20 to 0.24 m beside it), 57 deg over an axle (0.26 m)",
          {20.0, 120.0}, {50.0, 80.0}));
  VisitStuck(*this, v);
  VisitPatience(*this, v);
  v.Real("time_limit_s", time_limit_s,
         Setting("simulated time after which the run is stopped; 0: never; left open (null): four "
                 "hours for each 7.6 m of the course, four at least",
                 {0.0, 1e7},
                 "whether a clock ends runs; by default the four hours of a day of the MFEX rover, "
                 "Matthies 1995 sec. 2.1.2"));
  v.Real("hazard_height_m", hazard_height_m,
         Assumed("height from which a rock counts in hazards_met and hazards_missed; decides "
                 "nothing in the drive",
                 "the clearance of the undercarriage, Matthies 1995 sec. 6", {0.0, 10.0},
                 {0.075, 0.15}));
}

}  // namespace rockyard::trial
