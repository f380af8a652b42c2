// Which disparities a range of depths asks for (Goldberg 2002 section 2 stage 4: "derived
// geometrically from the input range of depth values").
#pragma once

#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// A rectified pair: parallel axes, rows aligned, one focal length.
struct StereoGeometry {
  double focal_px = 0.0;    // at the pyramid level that is correlated
  double baseline_m = 0.0;  // from the left to the right camera, positive
  double offset_px = 0.0;   // disparity of what is infinitely far: c_left - c_right of the columns
};

// Returns `correlator` with the range in which a point from nearest_m to farthest_m before the
// cameras (along their axes; farthest_m may be infinite) has its disparity
//   d = focal baseline / depth + offset,
// rounded outwards, and one disparity more on either side, which the peak filter needs. 0 <
// nearest_m <= farthest_m. Throws core::UserError where that is more than 512 disparities or
// reaches beyond 480 px.
CorrelatorParams SearchDepths(const StereoGeometry& pair, double nearest_m, double farthest_m,
                              CorrelatorParams correlator);

}  // namespace rockyard::vision
