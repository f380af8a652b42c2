#include "navigation/gestalt/remedy_params.h"

#include "core/sources.h"

namespace rockyard::navigation {

using core::Assumed;
using core::Setting;

void CostToGoParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("motions are voted on by the way that is left from their ends, searched over "
                    "what the rover has seen, in place of the direction of the goal"));
  v.Real("unseen_cost", unseen_cost,
         Assumed("cost of a metre of ground that was never seen, in metres of good ground",
                 "unseen ground is mostly good, and a seen way is to be preferred to it where they "
                 "are nearly as long",
                 {0.1, 100.0}, {1.0, 3.0}));
  v.Real("rough_cost", rough_cost,
         Assumed("cost of a metre of the worst ground that may be driven; goodness 255 costs 1, "
                 "and in between it is linear",
                 "hazard votes keep the rover off bad ground; the way only has to prefer the good",
                 {1.0, 100.0}, {1.0, 10.0}));
  v.Real("blocked_cost", blocked_cost,
         Assumed("cost of a metre of ground that must not be driven (votes.min_allowed_goodness)",
                 "through a rock that is grown by the vehicle, 1.2 m, it is longer than any detour "
                 "in the window",
                 {1.0, 1e4}, {20.0, 200.0}));
  v.Real("memory_m", memory_m,
         Setting("side of the square around the rover in which what was seen is remembered and the "
                 "way is searched; farther on the way is straight, over unseen ground",
                 {2.0, 60.0}));
  v.Choice("seen_again", seen_again,
           Assumed("what is remembered of a cell that was seen more than once",
                   "the map holds the mean of a cell's points, so that a wall seen from nearby can "
                   "open and shut again, and a way is not to lead there and back with it; but a "
                   "rover that drifts takes the walls of a narrow way out for farther in"));
  v.Real("way_m", way_m,
         Assumed("length of an arc, or of a straight drive after a turn, after which the way that "
                 "is left is asked for, or the distance to the goal if that is less; splines have "
                 "splines.waypoint_m",
                 "half of what is judged: arcs are replaced long before their end", {0.05, 20.0},
                 {0.7, 3.0}));
  v.Real("loss_m", loss_m,
         Assumed("way that a motion loses against the best one for which its vote is 0; the best "
                 "one has 255, and in between it is linear",
                 "straight away from the goal is twice way_m", {0.05, 100.0}, {0.5, 6.0}));
}

void StopToTurnParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("a rover that drives splines (csad) stops and turns in place where that saves "
                    "way, where it has turned without progress, and where no spline is safe"));
  v.Real("saves_m", saves_m,
         Assumed("way that a turn in place and a straight drive save against what would be driven "
                 "from which on they are made, those of turn_first, too; a goal inside the "
                 "tightest circle counts whatever it saves",
                 "a turn in place takes a rover of 7 cm/s as long as some half metre", {0.0, 20.0},
                 {0.25, 2.0}));
  v.Angle("orbit_turn_deg", orbit_turn_rad,
          Assumed("turning on the move without drive.progress_m of progress after which the rover "
                  "stops and turns in place",
                  "a full circle", {90.0, 3600.0}, {270.0, 720.0}));
}

void TurnFirstParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("turn in place towards the goal, or the way to it, before driving, where it "
                    "lies farther aside than bearing_deg and that saves stop_to_turn.saves_m"));
  v.Angle("bearing_deg", bearing_rad,
          Assumed("bearing of the way beyond which the rover turns in place first",
                  "arcs of 0.5 m radius waste little way up to abeam, and cameras of 60 deg to "
                  "either side have not seen what lies beyond",
                  {10.0, 180.0}, {45.0, 120.0}));
}

void AgainstDriftParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("motions are judged along the way that the rover makes good on them, by the "
                    "sideways drift that it measures: it heads uphill of its goal. An estimator "
                    "that goes by wheels alone measures none"));
  v.Real("memory_m", memory_m,
         Assumed("way over which the drift is averaged",
                 "two plans on the move: drift changes with the slope, and single motions are "
                 "measured to a centimetre",
                 {0.01, 100.0}, {0.5, 3.0}));
  v.Angle("max_angle_deg", max_angle_rad,
          Assumed("largest angle by which the rover aims off",
                  "a rover that drifts more than that is stuck rather than slipping", {0.0, 80.0},
                  {15.0, 45.0}));
}

void GestaltRemedyParams::Visit(core::FieldVisitor& v) {
  v.Group("cost_to_go", cost_to_go, "votes by the way that is left");
  v.Group("stop_to_turn", stop_to_turn, "turns in place of a rover that drives splines");
  v.Group("turn_first", turn_first, "turns in place before driving");
  v.Group("against_drift", against_drift, "aiming off against sideways slip");
}

}  // namespace rockyard::navigation
