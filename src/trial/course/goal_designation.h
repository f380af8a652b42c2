// What operators know and tell: the lander's map of the rocks, the goal that they designate.
#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "messages/estimates.h"
#include "sensing/aids.h"
#include "terrain/terrain.h"
#include "trial/course/course_params.h"
#include "trial/course/designation_params.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// A rock of the map, and which it is in truth.
struct MappedRock {
  terrain::Rock rock;        // as believed, in W: round, its base on the ground
  std::size_t index = 0;     // in Terrain::rocks()
  double range_m = 0.0;      // true, horizontal, from the mast to the nearest point that is seen
  double share_seen = 0.0;   // of the points that would be seen if it stood alone
  double resolved_px = 0.0;  // the smaller of its seen width and height
};

// The rocks that the cameras of course.designation show from a mast of course.lander_map, in the
// order of Terrain::rocks(). A rock is known where what other rocks and the ground leave of it is
// resolved_px wide and high and its nearest point no farther than reach_m.
//
// With f the horizontal distance of the nearest point seen and 2 alpha the angle between its
// outermost points, seen from above, a round rock has
//   r = f sin(alpha) / (1 - sin(alpha)), its centre at f + r:
// the far side is never seen, so that its depth is believed to be its width, and what is hidden of
// either side is believed not to be there. The height is that of the highest point seen above the
// ground. Errors, for the range R along the ray (Matthies 1995, eqs. 1 to 3):
//   each edge, left, right, top and base: sigma = edge_sd pixel_rad (an angle);
//   f: sigma = disparity_sd pixel_rad R^2 / B; sizes are the believed f times angles;
//   everything turns about the lander with the pan error of the trial, as designated goals do
//   (PanError_rad): map and goal are wrong together.
// Errors of rocks are independent of each other and of the goal's. To first order, as designation.
//
// Randomness: Purpose::kLanderMap, substream = the rock's index, always five numbers. Limits: no
// rover or lander hides anything; a matcher that fails, or rocks that it takes for one, are
// not modelled; the ground's height is known. A rock under the mast itself is not in the map. Cost:
// 10 to 30 us a rock, 7 ms among the rocks of VL-2 in the arena of the paper.
std::vector<MappedRock> MapFromLander(const CourseParams& course, const terrain::Terrain& terrain,
                                      core::TrialKey key);

// The places that a rover is told, as an operator designates them in the lander's stereo images,
// and the route that it is told to follow.

// True goal plus downrange and crossrange error, seen from the lander's cameras; the true goal
// where designation is off or the lander stands on it. Randomness: Purpose::kGoalDesignation,
// always three numbers (crossrange, downrange, pan), so that changing one error shifts no other.
// Cost: below 1 us.
messages::Goal DesignatedGoal(const CourseParams& course, core::TrialKey key);

// By how much the pan axis of the lander's cameras is wrong in a trial, positive to the left: what
// its goals, its waypoints and its map (MapFromLander) have in common. 0 where designation is off.
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
