#include "navigation/stuck_reaction_params.h"

namespace rockyard::navigation {

using core::Origin;

void StuckReactionParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "reaction", reaction,
      {.doc = "what follows where the rover notices that it is stuck "
              "(perception.stuck_detector): nothing, as it does not look for it; it gives up "
              "(no_path); or it drives back once in a drive and gives up the next time",
       .origin = Origin::kAssumed,
       .source = "neither Matthies 1995 nor Goldberg 2002 tells of a rover that notices it; one "
                 "of Matthies 1995 sec. 7 spun its wheels until its batteries were empty"});
  v.Real("back_off_m", back_off_m,
         {.doc = "way back of back_off, by wheel odometry, along the arc that was driven last",
          .min = 0.01,
          .max = 5.0,
          .origin = Origin::kAssumed,
          .source = "as navigation.pathfinder.vehicle_reaction.back_off_m: about a third of the "
                    "rover's length",
          .study_low = 0.065,
          .study_high = 0.40});
}

}  // namespace rockyard::navigation
