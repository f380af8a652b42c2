// The blob filter (Goldberg 2002 section 2 stage 6), the last stage of MatchStereo: small isolated
// regions are dropped.
//
// Two pixels side by side or one above the other are linked where both have a disparity and the
// disparities differ by blob_max_step_px or less. A region is a set of pixels that hang together by
// links; regions of fewer than blob_min_px pixels are dropped. Records of drives with stereo depend
// on which pixels that leaves; how runs are joined to regions is free.
#pragma once

#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// Drops small regions of `disparities`. Memory: 16 bytes for each run of linked pixels of a row.
void FilterBlobs(const StereoFilterParams& filters, DisparityImage& disparities);

}  // namespace rockyard::vision
