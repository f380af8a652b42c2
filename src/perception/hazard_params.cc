#include "perception/hazard_params.h"

#include "core/sources.h"
#include "messages/stripe_array.h"

namespace rockyard::perception {
namespace {

using core::Origin;

using core::kMatthiesSection6;

void VisitCriteria(HazardParams& p, core::FieldVisitor& v) {
  v.Real("neighbour_threshold_m", p.neighbour_threshold_m,
         {.doc = "elevation difference between 8-connected neighbours above which there is a "
                 "hazard",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = kMatthiesSection6});
  v.Real("range_threshold_m", p.range_threshold_m,
         {.doc = "difference between highest and lowest elevation of the whole array above which "
                 "there is a hazard",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "Matthies 1995 sec. 6: another threshold, without a value; taken as the "
                    "clearance of the "
                    "undercarriage",
          .study_low = 0.08,
          .study_high = 0.25});
  v.Integer(
      "neighbour_reach", p.neighbour_reach,
      {.doc = "rows and stripes up to which two points count as neighbours: 1 is the published "
              "8-connection; 2 compares points of a denser array that lie as far apart as "
              "neighbours of the published one",
       .min = 1,
       .max = static_cast<double>(messages::kMaxStripes),
       .origin = Origin::kPublished,
       .source = kMatthiesSection6});
  v.Choice("neighbour_blame", p.neighbour_blame,
           {.doc = "stripes charged with a neighbour difference",
            .origin = Origin::kAssumed,
            .source = "charges the rock or the pit rather than its neighbour"});
  v.Choice("range_blame", p.range_blame,
           {.doc = "stripes charged with the range of the array",
            .origin = Origin::kAssumed,
            .source = "charges the rock or the pit rather than the rest"});
}

void VisitAgreement(HazardParams& p, core::FieldVisitor& v) {
  v.Choice("agreement", p.agreement,
           {.doc = "scans that have to agree before a hazard is believed",
            .origin = Origin::kPublished,
            .source = kMatthiesSection6});
  v.Real("agree_m", p.agree_m,
         {.doc = "largest difference of an elevation between two scans that agree",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "Matthies 1995 sec. 6: a threshold, without a value",
          .study_low = 0.01,
          .study_high = 0.05});
  v.Choice("on_disagreement", p.on_disagreement,
           {.doc = "what follows when two scans that both show a hazard disagree (a later scan "
                   "without one is clear at once); in consecutive_moving, scan_again waits for the "
                   "next scan on the way",
            .origin = Origin::kAssumed,
            .source = "the scans have to agree, so the rover looks until two do"});
  v.Integer(
      "max_scans", p.max_scans,
      {.doc = "most scans at one pose",
       .min = 2,
       .max = 100,
       .origin = Origin::kAssumed,
       .source = "two of five scans with a wrong point in a fifth of them agree nearly always",
       .study_low = 2,
       .study_high = 10});
  v.Choice("on_exhausted", p.on_exhausted,
           {.doc = "what follows when max_scans scans have not agreed",
            .origin = Origin::kAssumed,
            .source = "a hazard that is still seen is believed"});
  v.Require("on_exhausted", p.on_exhausted != Disagreement::kScanAgain,
            "is scan_again, but the scans are used up",
            "use trust_last, treat_as_hazard or treat_as_clear");
}

}  // namespace

void HazardParams::Visit(core::FieldVisitor& v) {
  v.Boolean(
      "enabled", enabled,
      {.doc = "hazards are detected at all; false is a blind rover", .origin = Origin::kSetting});
  VisitCriteria(*this, v);
  VisitAgreement(*this, v);
}

}  // namespace rockyard::perception
