// The pipeline from rectified images to disparities (Goldberg 2002 section 2, stages 3 to 6).
//
// Each stage stands in a file of its own, with its definition, and can be called by itself:
//   1 pyramid.h               reduction by averaging
//   2 rectification_table.h   rows of both images aligned
//   3 dog.h                   difference of Gaussians
//   4 correlator.h            best matches of left and right
//   5 correlator.h            line of sight, peak filter, sub-pixel interpolation
//   6 blob.h                  small regions
//   range of disparities from depths: SearchDepths; stage 7, points, is the camera's part.
// Results are the same bits whatever the instruction set and the number of threads: terrain sensing
// of drives and places of visual odometry come from here, and trials repeat bit for bit. A plain
// form of every stage in the tests holds them; a faster stage has to give its bits.
#pragma once

#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// What the stages make; memory is used again where it is passed in again.
struct StereoProducts {
  GrayImage left_filtered;
  GrayImage right_filtered;
  DisparityImage disparities;
};

// Runs stages 3 to 6 on a rectified pair of one size (pyramid_level is not looked at). The rows of
// each stage but the last are split into as many bands as there are threads. Throws core::UserError
// where the images differ in size.
void MatchStereo(const GrayImage& left, const GrayImage& right, const StereoPipelineParams& params,
                 int threads, StereoProducts& products);

// Returns the disparities alone, by one thread.
DisparityImage MatchStereo(const GrayImage& left, const GrayImage& right,
                           const StereoPipelineParams& params);

}  // namespace rockyard::vision
