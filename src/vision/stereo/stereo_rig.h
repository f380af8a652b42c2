// A pair of cameras as it was calibrated: what software on board is given. The right camera that
// takes the images may have drifted since (rig_drift.h).
#pragma once

#include <cstdint>

#include "vision/cameras/camera_model.h"
#include "vision/image.h"

namespace rockyard::vision {

// Both cameras are told in one outer frame. A pixel is free (1) unless it shows the carrier itself
// (0): a mask that is part of a rig's calibration.
struct StereoRig {
  CameraModel left;
  CameraModel right;
  Image<std::uint8_t> left_free;
  Image<std::uint8_t> right_free;
};

}  // namespace rockyard::vision
