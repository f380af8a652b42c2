#include "navigation/pathfinder/vehicle_reaction_params.h"

namespace rockyard::navigation {

using core::Origin;

void VehicleReactionParams::Visit(core::FieldVisitor& v) {
  v.Real("back_off_m", back_off_m,
         {.doc = "measured drive backwards away from a felt hazard",
          .min = 0.01,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "a rover that touches a rock has to clear it before it turns: about a third of "
                    "its length",
          .study_low = 0.065,
          .study_high = 0.40});
  v.Angle("turn_deg", turn_rad,
          {.doc = "measured turn in place away from the side of the hazard",
           .min = 1.0,
           .max = 170.0,
           .origin = Origin::kAssumed,
           .source = "turns the front by half a vehicle width at half a vehicle length",
           .study_low = 20.0,
           .study_high = 90.0});
  v.Real("straight_m", straight_m,
         {.doc = "straight drive after the turn before steering to the goal again",
          .min = 0.0,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "half a vehicle length, past the rock: the controller has no memory of it",
          .study_low = 0.0,
          .study_high = 0.65});
  v.Integer("max_repeats", max_repeats,
            {.doc = "reactions in a row without progress_m of progress",
             .min = 1,
             .max = 1000,
             .origin = Origin::kAssumed,
             .source = "three quarters of a turn's worth of tries",
             .study_low = 2,
             .study_high = 20});
  v.Real("progress_m", progress_m,
         {.doc = "gain in the believed distance to the goal that counts as progress",
          .min = 0.001,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "half a vehicle width, as for the operator",
          .study_low = 0.1,
          .study_high = 0.5});
  v.Choice("on_exhausted", on_exhausted,
           {.doc = "what follows when max_repeats reactions have brought no progress",
            .origin = Origin::kAssumed,
            .source = "a rover that waits for its operators is safe"});
  v.Real("ignore_m", ignore_m,
         {.doc = "measured drive during which felt hazards are ignored where on_exhausted is go_on",
          .min = 0.01,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "most of a vehicle length",
          .study_low = 0.2,
          .study_high = 1.0});
}

}  // namespace rockyard::navigation
