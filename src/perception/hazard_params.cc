#include "perception/hazard_params.h"

#include "core/sources.h"
#include "messages/stripe_array.h"

namespace rockyard::perception {

namespace {

using core::Assumed;
using core::kMatthiesSection6;
using core::Published;
using core::Setting;

void VisitCriteria(HazardParams& p, core::FieldVisitor& v) {
  v.Real(
      "neighbour_threshold_m", p.neighbour_threshold_m,
      Published("elevation difference between 8-connected neighbours above which there is a hazard",
                kMatthiesSection6, {0.001, 10.0}));
  v.Real("range_threshold_m", p.range_threshold_m,
         Assumed("difference between highest and lowest elevation of the whole array above which "
                 "there is a hazard",
                 "Matthies 1995 sec. 6: another threshold, without a value; taken as the clearance "
                 "of the undercarriage",
                 {0.001, 10.0}, {0.08, 0.25}));
  v.Integer("neighbour_reach", p.neighbour_reach,
            Published("rows and stripes up to which two points count as neighbours: 1 is the "
                      "published 8-connection; 2 compares points of a denser array that lie as far "
                      "apart as neighbours of the published one",
                      kMatthiesSection6, {1, static_cast<double>(messages::kMaxStripes)}));
  v.Choice("neighbour_blame", p.neighbour_blame,
           Assumed("stripes charged with a neighbour difference",
                   "charges the rock or the pit rather than its neighbour"));
  v.Choice("range_blame", p.range_blame,
           Assumed("stripes charged with the range of the array",
                   "charges the rock or the pit rather than the rest"));
}

void VisitAgreement(HazardParams& p, core::FieldVisitor& v) {
  v.Choice("agreement", p.agreement,
           Published("scans that have to agree before a hazard is believed", kMatthiesSection6));
  v.Real("agree_m", p.agree_m,
         Assumed("largest difference of an elevation between two scans that agree",
                 "Matthies 1995 sec. 6: a threshold, without a value", {0.0, 10.0}, {0.01, 0.05}));
  v.Choice(
      "on_disagreement", p.on_disagreement,
      Assumed(
          "what follows when two scans that both show a hazard disagree (a later scan without one "
          "is clear at once); in consecutive_moving, scan_again waits for the next scan on the way",
          "the scans have to agree, so the rover looks until two do"));
  v.Integer("max_scans", p.max_scans,
            Assumed("most scans at one pose",
                    "two of five scans with a wrong point in a fifth of them agree nearly always",
                    {2, 100}, {2, 10}));
  v.Choice("on_exhausted", p.on_exhausted,
           Assumed("what follows when max_scans scans have not agreed",
                   "a hazard that is still seen is believed"));
  v.Require("on_exhausted", p.on_exhausted != Disagreement::kScanAgain,
            "is scan_again, but the scans are used up",
            "use trust_last, treat_as_hazard or treat_as_clear");
}

}  // namespace

void HazardParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled, Setting("hazards are detected at all; false is a blind rover"));
  VisitCriteria(*this, v);
  VisitAgreement(*this, v);
}

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
