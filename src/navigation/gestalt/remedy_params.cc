#include "navigation/gestalt/remedy_params.h"

#include "core/sources.h"

namespace rockyard::navigation {

using core::Assumed;
using core::Setting;

void StopToTurnParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("a rover that drives splines (csad) stops and turns in place where that saves "
                    "way, where it has turned without progress, and where no spline is safe"));
  v.Real("saves_m", saves_m,
         Assumed("way that a turn in place and a straight drive save against the best spline from "
                 "which on they are made; a goal inside the tightest circle counts whatever it "
                 "saves",
                 "a turn in place takes a rover of 7 cm/s as long as some half metre", {0.0, 20.0},
                 {0.25, 2.0}));
  v.Angle("orbit_turn_deg", orbit_turn_rad,
          Assumed("turning on the move without drive.progress_m of progress after which the rover "
                  "stops and turns in place",
                  "a full circle", {90.0, 3600.0}, {270.0, 720.0}));
}

void TurnFirstParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("turn in place towards the goal, or the way to it, before driving, where it "
                    "lies farther aside than bearing_deg"));
  v.Angle("bearing_deg", bearing_rad,
          Assumed("bearing of the way beyond which the rover turns in place first",
                  "arcs of 0.5 m radius waste little way up to abeam, and cameras of 60 deg to "
                  "either side have not seen what lies beyond",
                  {10.0, 180.0}, {45.0, 120.0}));
}

void GestaltRemedyParams::Visit(core::FieldVisitor& v) {
  v.Group("stop_to_turn", stop_to_turn, "turns in place of a rover that drives splines");
  v.Group("turn_first", turn_first, "turns in place before driving");
}

}  // namespace rockyard::navigation
