// The pipeline from rectified images to disparities (Goldberg 2002 section 2, stages 3 to 6). The
// rover's stereo, the commands that match pairs of images, and visual odometry that places features
// by a disparity map run it.
//
// Each stage is defined in a file of its own and can be called by itself:
//   1 pyramid.h               reduction by averaging
//   2 rectification_table.h   rows of both images aligned
//   3 dog.h                   difference of Gaussians
//   4 correlator.h            best matches of left and right
//   5 correlator.h            line of sight, peak filter, sub-pixel interpolation
//   6 blob.h                  small regions
// SearchDepths (stereo_params.h) gives the range of disparities for a range of depths; Triangulate
// (cameras/rectification.h) makes the points of stage 7.
// Records depend on every bit of the results: they must be the same for every instruction set and
// number of threads, and equal those of the plain form of each stage in the tests.
#pragma once

#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// What the stages make. Products that are passed in again lend their memory.
struct StereoProducts {
  GrayImage left_filtered;
  GrayImage right_filtered;
  DisparityImage disparities;
};

// Runs stages 3 to 6 on a rectified pair of one size; callers have reduced the images by
// pyramid_level before. The rows of each stage but the last are split into as many bands as there
// are threads. Throws core::UserError where the images differ in size.
void MatchStereo(const GrayImage& left, const GrayImage& right, const StereoPipelineParams& params,
                 int threads, StereoProducts& products);

// Returns the disparities alone, by one thread.
DisparityImage MatchStereo(const GrayImage& left, const GrayImage& right,
                           const StereoPipelineParams& params);

}  // namespace rockyard::vision
