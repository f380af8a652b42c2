// Errors of matched disparities against the truth, pixel by pixel.
#pragma once

#include "experiments/stereo_sensing/stereo_sums.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_ground_truth.h"
#include "sensing/stereo_view.h"

namespace rockyard::experiments {

// What of a look belongs to a cell, and how its pixels are told apart.
struct PixelLimits {
  double nearest_m = 0.0;   // true range from the left camera, along the ray
  double farthest_m = 0.0;  // not included
  double min_disparity_px = 0.0;
  double max_disparity_px = 0.0;
  int edge_reach_px = 0;  // within as many columns of a jump in depth a pixel is beside it
};

// Adds the pixels of one look to `sums`. `matched_px` are disparities on the pixels of `truth`, 0
// where there is no match; `view` is the left eye's, in any frame. True disparities outside the
// searched range do not count. Pairs of neighbours lie in one row and within the cell.
void AddPixels(const sensing::StereoTruth& truth, const sensing::DepthImage& matched_px,
               const sensing::StereoView& view, const PixelLimits& limits, StereoSums& sums);

}  // namespace rockyard::experiments
