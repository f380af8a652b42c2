// What operators know and tell the rover: the goal, waypoints and route that they designate in the
// stereo images of the lander, and the lander's map of the rocks. Drive takes told places and route
// from it, the aids of a drive the lander's place and pan error, missions the pan error, and the
// experiment on designation the told goal.
//
// Ranges are horizontal distances from the lander's cameras, unless they are said to be along a
// ray.
//
// Records depend on the random numbers: Purpose::kGoalDesignation with the substreams 0 (goal) and
// 1, 2, ... (waypoints), always three numbers each (crossrange, downrange, pan), and
// Purpose::kLanderMap with a rock's index as substream, always five numbers. They are drawn whether
// or not they are used, so that no error, waypoint or rock shifts the numbers of another.
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

// A rock of the map, and the true rock that it stands for.
struct MappedRock {
  terrain::Rock rock;        // as believed, in W: round, its base on the ground
  std::size_t index = 0;     // of the true rock in Terrain::rocks()
  double range_m = 0.0;      // true, from the mast to the nearest point that is seen
  double share_seen = 0.0;   // of the points that would be seen if the rock stood alone
  double resolved_px = 0.0;  // the smaller of its seen width and height
};

// Returns the lander's map: the rocks that the stereo pair of course.designation shows from a mast
// of course.lander_map, in the order of Terrain::rocks(). The map has a rock if its seen part,
// which other rocks and the ground leave, is at least resolved_px wide and high, and if the nearest
// seen point is no farther than reach_m. Both are judged by true angles and ranges.
//
// With f the range of the nearest seen point and 2 alpha the angle between the outermost seen
// points, as seen from above, a round rock has
//   r = f sin(alpha) / (1 - sin(alpha)), its centre at f + r.
// The far side is never seen: the believed depth of a rock is its width, and what is hidden of
// either side is believed not to be there. The believed height is that of the highest seen point
// above the ground. Random errors, to first order as those of designation and independent for each
// rock, with R the range along the ray (Matthies 1995, eqs. 1 and 2):
//   left, right, top and base edge: sigma = edge_sd pixel_rad (an angle);
//   f: sigma = disparity_sd pixel_rad R^2 / B; sizes are the believed f times angles.
// One error is common to all rocks and to designated goals: everything turns about the lander by
// the pan error of the trial (PanError_rad; eq. 3), so that map and goal are wrong together.
//
// Limits: no rover or lander hides anything; a matcher that fails, or that takes several rocks for
// one, is not modelled; the ground's height is known. A rock under the mast itself is not in the
// map. Cost: 10 to 30 us a rock, 7 ms among the rocks of VL-2 in the arena of the paper.
std::vector<MappedRock> MapFromLander(const CourseParams& course, const terrain::Terrain& terrain,
                                      core::TrialKey key);

// Returns the told goal: the true goal plus downrange and crossrange error, as seen from the
// lander's cameras; the true goal where designation is off or the lander stands on the goal. Cost:
// below 1 us.
messages::Goal DesignatedGoal(const CourseParams& course, core::TrialKey key);

// Returns by how much the pan axis of the lander's cameras is wrong in a trial, positive to the
// left: the error that goals, waypoints and map (MapFromLander) have in common. 0 where designation
// is off.
double PanError_rad(const DesignationParams& designation, core::TrialKey key);

// Returns the told waypoints of the course in the order of driving, then DesignatedGoal. Each
// waypoint is designated from the same place as the goal, by its own range and with random errors
// of its own; the goal does not depend on waypoints. All have the pan error of the trial.
std::vector<messages::Goal> DesignatedGoals(const CourseParams& course, core::TrialKey key);

// Returns where the lander stands, with the pan error of the trial, for the aids of a drive.
sensing::LanderPlace LanderPlaceOf(const CourseParams& course, core::TrialKey key);

// Returns the route to `goal` that is planned, before anything moves, on the map that
// course.route_map.source names: the true rocks, or MapFromLander. Empty where that map shows no
// way.
messages::Route ToldRoute(const DriveParams& drive, const terrain::Terrain& terrain,
                          core::TrialKey key, const messages::Goal& goal);

// Returns the places that the rover is told to drive to, in the order of driving, the goal last:
// DesignatedGoals or, where course.route_map.use is waypoints, the corners of ToldRoute that are at
// least spacing_m from the place before and from the goal, then the designated goal. The list is
// the goal alone where the map shows no way, or a straight one.
std::vector<messages::Goal> ToldPlaces(const DriveParams& drive, const terrain::Terrain& terrain,
                                       core::TrialKey key);

}  // namespace rockyard::trial
