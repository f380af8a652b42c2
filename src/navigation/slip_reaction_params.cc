#include "navigation/slip_reaction_params.h"

namespace rockyard::navigation {

using core::Origin;

void SlipReactionParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "reaction", reaction,
      {.doc = "what follows an alarm of perception.visual_odometry.slip_check: the drive stops "
              "(excessive_slip); what on_board_stuck.reaction says; or the navigator takes it "
              "as a hazard that the rover feels where it drives to, and goes on by its own "
              "rules for these",
       .origin = Origin::kAssumed,
       .source = "Howard 2012 has slip checking without saying what follows"});
  v.Integer("max_alarms", max_alarms,
            {.doc = "alarms that a drive goes on after; the next one ends it (excessive_slip). "
                    "Without effect where it stops at the first",
             .min = 0,
             .max = 1000,
             .origin = Origin::kAssumed,
             .source = "each costs a manoeuvre, and says that the way leads through such ground",
             .study_low = 1,
             .study_high = 10});
}

}  // namespace rockyard::navigation
