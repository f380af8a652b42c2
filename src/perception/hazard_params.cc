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

}  // namespace rockyard::perception
