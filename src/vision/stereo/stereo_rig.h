// A pair of cameras as it was calibrated. The stereo imager makes it, and the rover's stereo and
// visual odometry read images by it. The right camera that takes the images may have drifted since
// (cameras/rig_drift.h).
#pragma once

#include <cstdint>

#include "vision/cameras/camera_model.h"
#include "vision/image.h"

namespace rockyard::vision {

// Both cameras are told in one outer frame. The masks are part of the calibration: a pixel is 0
// where it shows the rover itself, 1 elsewhere.
struct StereoRig {
  CameraModel left;
  CameraModel right;
  Image<std::uint8_t> left_free;
  Image<std::uint8_t> right_free;
};

}  // namespace rockyard::vision
