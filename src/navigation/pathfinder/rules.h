// The rules of the Pathfinder controller (Matthies 1995, section 7; pathfinder.h): which way a
// report or the goal makes the rover turn. Pure functions.
#pragma once

#include "messages/estimates.h"
#include "navigation/pathfinder/pathfinder_params.h"

namespace rockyard::navigation {

// Directions of turns in place.
inline constexpr int kLeft = +1;
inline constexpr int kRight = -1;

// The sides on which a report shows hazards.
struct HazardSides {
  bool left = false;
  bool centre = false;
  bool right = false;

  bool any() const { return left || centre || right; }
};

HazardSides ClassifySides(const messages::HazardReport& report, const PathfinderParams& params);

// Returns the turn direction (+1 left, -1 right) that the rules choose. `goal_bearing_rad` is
// positive when the goal lies to the left. The report must show a hazard.
int ChooseTurn(const messages::HazardReport& report, double goal_bearing_rad,
               const PathfinderParams& params);

// Returns the curvature (1/m, positive left) that leads towards a goal at the given bearing.
double CurvatureToGoal(double goal_bearing_rad, const PathfinderParams& params);

}  // namespace rockyard::navigation
