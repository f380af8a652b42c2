// How on-board stereo matches the images of a pair.
#pragma once

#include <cstdint>

#include "core/fields.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::perception {

// The pipeline of vision/stereo, without what the cameras and their range fix: reduction and
// disparities.
struct StereoMatchingParams {
  vision::DogParams dog;
  std::int64_t window_side_px = 7;
  vision::StereoFilterParams filters;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception
