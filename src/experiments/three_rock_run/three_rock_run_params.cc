#include "experiments/three_rock_run/three_rock_run_params.h"

#include <string_view>

namespace rockyard::experiments {
namespace {

using core::Origin;

void VisitRange(core::FieldVisitor& v, std::string_view name, UniformRange& range,
                const core::FieldInfo& info) {
  v.FixedReals(name, range, info);
  v.Require(name, range[0] <= range[1], "ends below its start",
            "give the lowest value first, then the highest");
}

core::FieldInfo Assumed(std::string_view doc, double min, double max, std::string_view reason) {
  return {.doc = doc, .min = min, .max = max, .origin = Origin::kAssumed, .source = reason};
}

}  // namespace

void ThreeRockPrior::Visit(core::FieldVisitor& v) {
  VisitRange(v, "goal_m", goal_m,
             Assumed("start to goal, straight", 3.0, 100.0,
                     "below the 8.1 m that were driven, around the 7.6 m of section 7"));
  VisitRange(v, "a_gap_m", a_gap_m,
             Assumed("from the rover's front to the near end of rock A where it is detected", 0.0,
                     5.0, "the light stripe's array spans 0.3 m ahead (sec. 6)"));
  VisitRange(v, "a_offset_m", a_offset_m,
             Assumed("centre of rock A beside the line to the goal, to the left", -5.0, 5.0,
                     "half of the array's width: farther out it is no hazard"));
  VisitRange(v, "b_path_m", b_path_m,
             Assumed("path at which the rover's centre would come to rock B", 0.5, 100.0,
                     "after the way around A, and with room for C before the end"));
  VisitRange(v, "b_offset_m", b_offset_m,
             Assumed("centre of rock B beside that path, to the left", -5.0, 5.0,
                     "half of the rover's width and the largest rock's radius"));
  VisitRange(v, "c_gap_m", c_gap_m,
             Assumed("path from rock B to rock C", 0.1, 100.0,
                     "a straight stretch between them (sec. 5), and the way around C to follow"));
  VisitRange(v, "c_offset_m", c_offset_m,
             Assumed("centre of rock C beside the path past B, to the left", -5.0, 5.0,
                     "in the array's width with some of its radius"));
  VisitRange(v, "tall_height_m", tall_height_m,
             Assumed("heights of rocks A and C above the ground", 0.01, 5.0,
                     "from what is detected (0.075 m) to what a goal rock may be"));
  VisitRange(v, "low_height_m", low_height_m,
             Assumed("height of rock B above the ground", 0.01, 5.0,
                     "from the underside of a hub (0.04 m) to above the detection threshold"));
  VisitRange(v, "diameter_m", diameter_m,
             Assumed("diameters of all three rocks", 0.02, 5.0,
                     "usual rocks of nominal terrain that a rover meets"));
}

void ThreeRockTold::Visit(core::FieldVisitor& v) {
  v.Real("length_m", length_m,
         {.doc = "true length of the run",
          .min = 0.1,
          .max = 1000.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5"});
  v.Real("length_tolerance_m", length_tolerance_m,
         {.doc = "either way", .min = 0.0, .max = 1000.0, .origin = Origin::kSetting});
  v.Real("a_path_m", a_path_m,
         {.doc = "path at which the rover turns in place to avoid rock A",
          .min = 0.1,
          .max = 1000.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5"});
  v.Real("a_path_tolerance_m", a_path_tolerance_m,
         {.doc = "either way", .min = 0.0, .max = 1000.0, .origin = Origin::kSetting});
  v.Angle("c_turn_deg", c_turn_rad,
          {.doc = "turn in place at rock C",
           .min = 0.0,
           .max = 360.0,
           .origin = Origin::kPublished,
           .source = "Matthies 1995 sec. 5: about 20 deg"});
  v.Angle("c_turn_tolerance_deg", c_turn_tolerance_rad,
          {.doc = "either way", .min = 0.0, .max = 360.0, .origin = Origin::kSetting});
  v.Integer("b_scrapes", b_scrapes,
            {.doc = "fewest scrapes of rock B, which was scraped considerably",
             .min = 1,
             .max = 100,
             .origin = Origin::kSetting});
  v.Boolean("false_alarm", false_alarm,
            {.doc = "a hazard is believed where there is none before rock A is detected, as in "
                    "the published run",
             .origin = Origin::kSetting});
}

}  // namespace rockyard::experiments
