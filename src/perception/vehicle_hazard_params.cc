#include "perception/vehicle_hazard_params.h"

namespace rockyard::perception {
namespace {

using core::Origin;

void Ticks(core::FieldVisitor& v, std::string_view name, std::int64_t& ticks,
           std::string_view reason, double study_high) {
  v.Integer(name, ticks,
            {.doc = "control ticks in a row beyond the threshold that make a hazard",
             .min = 1,
             .max = 10000,
             .origin = Origin::kAssumed,
             .source = reason,
             .study_low = 1,
             .study_high = study_high});
}

}  // namespace

void VehicleHazardParams::Visit(core::FieldVisitor& v) {
  v.Angle("max_tilt_deg", max_tilt_rad,
          {.doc = "tilt of the chassis above which there is a hazard",
           .min = 0.5,
           .max = 90.0,
           .origin = Origin::kAssumed,
           .source = "half of the static tipping angle; a chassis on one wheel at 1.5 wheel "
                     "diameters leans by less",
           .study_low = 15.0,
           .study_high = 40.0});
  v.Angle("max_rocker_deg", max_rocker_rad,
          {.doc = "size of a rocker's angle above which there is a hazard",
           .min = 0.5,
           .max = 90.0,
           .origin = Origin::kAssumed,
           .source = "three fifths of the way to its stop",
           .study_low = 8.0,
           .study_high = 22.0});
  v.Angle("max_bogie_deg", max_bogie_rad,
          {.doc = "size of a bogie's angle above which there is a hazard",
           .min = 0.5,
           .max = 90.0,
           .origin = Origin::kAssumed,
           .source = "three fifths of the way to its stop: a front wheel 13 cm up",
           .study_low = 20.0,
           .study_high = 45.0});
  v.Real(
      "max_current_A", max_current_A,
      {.doc = "motor current above which there is a hazard",
       .min = 1e-6,
       .max = 1000.0,
       .origin = Origin::kAssumed,
       .source = "1 N m of torque at the wheel, less than half of the stall torque and beyond what "
                 "rolling over rocks takes; extreme terrain takes 89 mA by Matthies 1995 table 1",
       .study_low = 0.04,
       .study_high = 0.13});
  Ticks(v, "tilt_ticks", tilt_ticks, "a lurch is no slope", 10);
  Ticks(v, "articulation_ticks", articulation_ticks, "one noisy sample is no hazard", 10);
  Ticks(v, "current_ticks", current_ticks, "starting takes more than rolling", 10);
  Ticks(v, "contact_ticks", contact_ticks, "a switch that closes has touched something", 3);
}

}  // namespace rockyard::perception
