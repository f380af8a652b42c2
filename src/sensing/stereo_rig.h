// What the stereo cameras of a rover deliver, and what is known of them on board. The imager makes
// these images; on-board stereo and visual odometry read them by the calibrated rig. Records of
// drives by these images depend on the bits of cameras and masks.
#pragma once

#include <utility>

#include "messages/point_cloud.h"
#include "rover/rover_geometry_params.h"
#include "sensing/stereo_params.h"
#include "vision/cameras/camera_model.h"
#include "vision/image.h"
#include "vision/stereo/stereo_rig.h"

namespace rockyard::sensing {

// The images of one look: 8 bits a pixel, of imagers with more bits the highest eight.
struct StereoImages {
  vision::GrayImage left;
  vision::GrayImage right;
  double exposure_s = 0.0;  // of both images: exposure control looks at the left one
};

// Returns the left and the right camera of the pair that looks in `direction` as they were
// calibrated, in R: linear cameras with the view of MakeStereoView, of 2^pyramid_level times its
// columns and rows. StereoImager takes its images with the same cameras, but for their drift.
std::pair<vision::CameraModel, vision::CameraModel> CalibratedCameras(
    const StereoParams& params, messages::LookDirection direction);

// Returns the same pair with masks of the pixels that show the rover's own parts.
vision::StereoRig CalibratedRig(const StereoParams& params, const rover::RoverGeometryParams& rover,
                                messages::LookDirection direction);

}  // namespace rockyard::sensing
