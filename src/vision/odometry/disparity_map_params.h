// Parameters of places that come from a dense disparity map.
#pragma once

#include <cstdint>

#include "core/fields.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// How the map is made (vision/stereo), and what its disparities are worth.
struct DisparityMapParams {
  DogParams dog;
  std::int64_t window_side_px = 7;
  StereoFilterParams filters;
  double noise_px = 0.15;
  double max_step_px = 1.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::vision
