// On-board stereo: from the images of a pair to points in R (Goldberg 2002 section 2). Drives at
// the image fidelity of the stereo sensor see by it; what watches drives shows its disparities.
// Records of those drives depend on its bits, and on which pixels are dropped.
#pragma once

#include <vector>

#include "math/pose.h"
#include "perception/aligned_eyes.h"
#include "perception/eyes_params.h"
#include "vision/cameras/rectification.h"
#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_rig.h"

namespace rockyard::perception {

// What the matching searches, from sensors.stereo. Disparities are in pixels of the reduced images.
struct StereoSearch {
  int pyramid_level = 0;          // images are reduced by 2^level
  double min_disparity_px = 0.0;  // > 0
  double max_disparity_px = 0.0;  // > min, at most 400
  double max_range_m = 0.0;       // points farther from the left camera are dropped
};

// What one pair of images shows.
struct StereoSight {
  vision::GrayImage left;              // reduced and aligned, as it was matched
  vision::DisparityImage disparities;  // of its pixels
  std::vector<math::Vector3> points_R;
};

// One pair of cameras as its calibration has it. The stages are those of vision/stereo. Both images
// are reduced, resampled unless the cameras are aligned already, filtered and matched. Then pixels
// are dropped whose windows reach over the edge of an image or show the rover itself, whose
// disparities lie outside of the searched range, or whose points are farther than max_range_m.
class StereoPoints {
 public:
  // Throws core::UserError where the cameras cannot be aligned.
  StereoPoints(const StereoMatchingParams& params, const StereoSearch& search,
               const vision::StereoRig& rig);

  // Returns what images of the rig's size show, one point a pixel at most. It is a pure function.
  // Cost: 0.3 ms for 128 x 128 pixels and 16 disparities, and as much for reducing 512 x 512 pixels
  // to 128 x 128.
  StereoSight See(const vision::GrayImage& left, const vision::GrayImage& right) const;

  const vision::RectifiedPair& pair() const { return eyes_.pair(); }
  const vision::StereoPipelineParams& params() const { return params_; }

 private:
  void DropOutOfRange(vision::DisparityImage& disparities) const;
  std::vector<math::Vector3> PointsOf(const vision::DisparityImage& disparities) const;

  vision::StereoPipelineParams params_;
  StereoSearch search_;
  AlignedEyes eyes_;
};

}  // namespace rockyard::perception
