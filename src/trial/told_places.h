// The places that the rover is told to drive to, and the route that it is told to follow.
#pragma once

#include <vector>

#include "core/random.h"
#include "messages/estimates.h"
#include "messages/route.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

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
