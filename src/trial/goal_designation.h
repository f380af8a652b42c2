// The places that a rover is told, as an operator designates them in the lander's stereo images,
// and the route that it is told to follow.
#pragma once

#include <vector>

#include "core/random.h"
#include "messages/estimates.h"
#include "sensing/aids.h"
#include "terrain/terrain.h"
#include "trial/course_params.h"
#include "trial/designation_params.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// True goal plus downrange and crossrange error, seen from the lander's cameras; the true goal
// where designation is off or the lander stands on it. Randomness: Purpose::kGoalDesignation,
// always three numbers (crossrange, downrange, pan), so that changing one error shifts no other.
// Cost: below 1 us.
messages::Goal DesignatedGoal(const CourseParams& course, core::TrialKey key);

// By how much the pan axis of the lander's cameras is wrong in a trial, positive to the left: what
// its goals, its waypoints and its map (lander_map.h) have in common. 0 where designation is off.
double PanError_rad(const DesignationParams& designation, core::TrialKey key);

// Every waypoint of the course in the order of driving, then DesignatedGoal. Each waypoint is
// designated from the same place as the goal, by its own range and with random errors of its own
// (the same stream, substream 1, 2, ...; the goal's is 0, so that it does not depend on waypoints).
// The pan axis is wrong by one angle in a trial, whatever is designated.
std::vector<messages::Goal> DesignatedGoals(const CourseParams& course, core::TrialKey key);

// By course.designation, about the line from start to goal. The pan error is that of the trial
// where goals are designated with it and 0 where they are not.
sensing::LanderPlace LanderPlaceOf(const CourseParams& course, core::TrialKey key);

// The route to `goal` that is planned on the map of course.route_map, as it is before anything
// moves; empty where that map shows no way.
messages::Route ToldRoute(const DriveParams& drive, const terrain::Terrain& terrain,
                          core::TrialKey key, const messages::Goal& goal);

// In the order of driving, the goal last: DesignatedGoals, or, where course.route_map.use is
// waypoints, the corners of ToldRoute to the designated goal that lie spacing_m from the one before
// and from the goal. Where the map shows no way, and where it shows a straight one, that is the
// goal alone.
std::vector<messages::Goal> ToldPlaces(const DriveParams& drive, const terrain::Terrain& terrain,
                                       core::TrialKey key);

}  // namespace rockyard::trial
