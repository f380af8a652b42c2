// The blob filter (Goldberg 2002 section 2 stage 6): small isolated regions are thrown out.
//
// Two pixels side by side or one above the other are of one region where both have a disparity and
// the two differ by no more than a parameter; a region is all that hangs together that way. Those
// of fewer pixels than a parameter are dropped.
#pragma once

#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// Drops small regions of `disparities`. The cost is that of a few looks at each pixel and of
// joining runs of connected pixels of a row, in memory 16 bytes a run.
void FilterBlobs(const StereoFilterParams& filters, DisparityImage& disparities);

}  // namespace rockyard::vision
