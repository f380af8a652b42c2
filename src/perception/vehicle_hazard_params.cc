#include "perception/vehicle_hazard_params.h"

namespace rockyard::perception {
namespace {

using core::Assumed;

void Ticks(core::FieldVisitor& v, std::string_view name, std::int64_t& ticks,
           std::string_view reason, double study_low, double study_high) {
  v.Integer(name, ticks,
            Assumed("control ticks in a row beyond the threshold that make a hazard", reason,
                    {1, 10000}, {study_low, study_high}));
}

}  // namespace

void VehicleHazardParams::Visit(core::FieldVisitor& v) {
  v.Angle("max_tilt_deg", max_tilt_rad,
          Assumed("tilt of the chassis above which there is a hazard",
                  "half of the static tipping angle; a chassis on one wheel at 1.5 wheel diameters "
                  "leans by less",
                  {0.5, 90.0}, {15.0, 40.0}));
  v.Angle("max_rocker_deg", max_rocker_rad,
          Assumed("size of a rocker's angle above which there is a hazard",
                  "three fifths of the way to its stop", {0.5, 90.0}, {8.0, 22.0}));
  v.Angle("max_bogie_deg", max_bogie_rad,
          Assumed("size of a bogie's angle above which there is a hazard",
                  "halfway between the 39 deg by which a single rock of two wheel radii bends it, "
                  "which the rover may drive over, and its stop",
                  {0.5, 90.0}, {40.0, 48.0}));
  v.Real("max_current_A", max_current_A,
         Assumed("motor current above which a wheel that hardly turns has stalled",
                 "nine tenths of the current at Rocky 3.2's stall torque of 4 N m; extreme terrain "
                 "takes 89 mA by Matthies 1995 table 1",
                 {1e-6, 1000.0}, {0.13, 0.195}));
  v.Real("max_turn_share", max_turn_share,
         Assumed("share of what a wheel was told to turn below which it hardly turns; from 2 on "
                 "the current alone decides",
                 "a motor at its stall torque stands; a fifth leaves room for the errors of "
                 "encoders over a tick and for wheels that creep",
                 {0.0, 2.0}, {0.05, 0.5}));
  Ticks(v, "tilt_ticks", tilt_ticks, "a lurch is no slope", 1, 10);
  Ticks(v, "articulation_ticks", articulation_ticks, "one noisy sample is no hazard", 1, 10);
  Ticks(v, "current_ticks", current_ticks,
        "1.5 s at 20 Hz: a wheel that climbs hesitates for less, one that is stuck goes on", 20,
        60);
  Ticks(v, "contact_ticks", contact_ticks, "a switch that closes has touched something", 1, 3);
}

}  // namespace rockyard::perception
