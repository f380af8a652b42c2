// What the operators know of the rocks from the lander's stereo pair.
#pragma once

#include <cstddef>
#include <vector>

#include "core/random.h"
#include "terrain/terrain.h"
#include "trial/course_params.h"

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

}  // namespace rockyard::trial
