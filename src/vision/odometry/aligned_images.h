// Two images of one moment with aligned rows.
#pragma once

#include "vision/image.h"
#include "vision/stereo/disparity.h"

namespace rockyard::vision {

struct AlignedImages {
  GrayImage left;
  GrayImage right;
  // Of the left image's pixels, where stereo has matched these images already; else empty, and made
  // where places are taken from it (PlacementParams::source).
  DisparityImage disparities = {};
};

}  // namespace rockyard::vision
