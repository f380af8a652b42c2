// What the stereo cameras of a rover deliver, and what is known of them on board.
#pragma once

#include <utility>

#include "messages/point_cloud.h"
#include "rover/rover_geometry_params.h"
#include "sensing/stereo_params.h"
#include "vision/cameras/camera_model.h"
#include "vision/image.h"
#include "vision/stereo/stereo_rig.h"

namespace rockyard::sensing {

// What one look delivers: 8 bits a pixel, the highest ones of imagers that have more.
struct StereoImages {
  vision::GrayImage left;
  vision::GrayImage right;
  double exposure_s = 0.0;  // of both: exposure control looks at the left image
};

// Returns the pair that looks there as it was calibrated, left and right, in R: linear cameras with
// the view of MakeStereoView, of 2^pyramid_level times its columns and rows. StereoImager takes its
// images with these, but for what drifted since.
std::pair<vision::CameraModel, vision::CameraModel> CalibratedCameras(
    const StereoParams& params, messages::LookDirection direction);

// The same with a mask of the rover's own parts, which each pixel's ray is held against.
vision::StereoRig CalibratedRig(const StereoParams& params, const rover::RoverGeometryParams& rover,
                                messages::LookDirection direction);

}  // namespace rockyard::sensing
