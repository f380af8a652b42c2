#include "navigation/reaction_params.h"

namespace rockyard::navigation {

using core::Assumed;

void StuckReactionParams::Visit(core::FieldVisitor& v) {
  v.Choice("reaction", reaction,
           Assumed("what follows where the rover notices that it is stuck "
                   "(perception.stuck_detector): nothing, as it does not look for it; it gives up "
                   "(no_path); or it drives back once in a drive and gives up the next time",
                   "neither Matthies 1995 nor Goldberg 2002 tells of a rover that notices it; one "
                   "of Matthies 1995 sec. 7 spun its wheels until its batteries were empty"));
  v.Real("back_off_m", back_off_m,
         Assumed("way back of back_off, by wheel odometry, along the arc that was driven last",
                 "as navigation.pathfinder.vehicle_reaction.back_off_m: about a third of the "
                 "rover's length",
                 {0.01, 5.0}, {0.065, 0.40}));
}

void SlipReactionParams::Visit(core::FieldVisitor& v) {
  v.Choice(
      "reaction", reaction,
      Assumed(
          "what follows an alarm of perception.visual_odometry.slip_check: the drive stops "
          "(excessive_slip); what on_board_stuck.reaction says; or the navigator takes it as a "
          "hazard that the rover feels where it drives to, and goes on by its own rules for these",
          "Howard 2012 has slip checking without saying what follows"));
  v.Integer("max_alarms", max_alarms,
            Assumed("alarms that a drive goes on after; the next one ends it (excessive_slip). "
                    "Without effect where it stops at the first",
                    "each costs a manoeuvre, and says that the way leads through such ground",
                    {0, 1000}, {1, 10}));
}

}  // namespace rockyard::navigation
