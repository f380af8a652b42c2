#include "navigation/gestalt/continuous_params.h"

namespace rockyard::navigation {

using core::Origin;

void GestaltContinuousParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "cycle", cycle,
      {.doc = "whether the rover stops to look (stop_and_look), looks and plans while it drives "
              "arcs and stands to steer (csod), or drives clothoid splines and stands for "
              "nothing (csad); the last two need clock.overlap",
       .origin = Origin::kSetting});
  v.Real(
      "motion_m", motion_m,
      {.doc = "length of the motion that is driven of a plan, as measured on board, where no "
              "later plan replaces it; with csod or csad",
       .min = 0.05,
       .max = 5.0,
       .origin = Origin::kAssumed,
       .source = "Howard 2012 sec. 2: it \"does not execute the entire path that was selected\", "
                 "3 m; about a vehicle's length",
       .study_low = 0.35,
       .study_high = 3.0});
  v.Real("replan_fraction", replan_fraction,
         {.doc = "share of motion_m after which the rover looks for its next plan",
          .min = 0.01,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "Howard 2012 sec. 2: \"once a fraction of the executed motion is complete\"; "
                    "which is not told",
          .study_low = 0.1,
          .study_high = 1.0});
  v.Choice("plan_start", plan_start,
           {.doc = "where a plan that is made on the move begins",
            .origin = Origin::kAssumed,
            .source = "Howard 2012 sec. 2: curvature matches \"at the point where the command is "
                      "executed\", which is ahead of where the rover looked"});
  v.Choice(
      "no_safe_plan", no_safe_plan,
      {.doc = "what the rover does on the move where no new plan is safe",
       .origin = Origin::kAssumed,
       .source = "Howard 2012 does not tell; what was seen last says that the way is not safe"});
  v.Choice(
      "late_plan", late_plan,
      {.doc = "what the rover does at the end of its motion where the next plan is not ready",
       .origin = Origin::kAssumed,
       .source = "Howard 2012 does not tell; what was seen is still true of a rover that waits"});
}

}  // namespace rockyard::navigation
