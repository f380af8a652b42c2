// Disparities near the edge of what a camera saw: a rectified image has pixels that come from
// nowhere, and windows that reach over them compare nothing.
#pragma once

#include <cstdint>

#include "vision/image.h"
#include "vision/stereo/disparity.h"

namespace rockyard::vision {

// Drops (kOutside) every pixel whose window, or the window of its match, reaches over a pixel that
// is 0 in `left_inside` or `right_inside` (RectificationTable::Inside). The window has side
// `window_side_px`, its pixel at side / 2. All images are of one size. Pixels that another filter
// has dropped stay as they are.
void DropOutside(const Image<std::uint8_t>& left_inside, const Image<std::uint8_t>& right_inside,
                 int window_side_px, DisparityImage& disparities);

}  // namespace rockyard::vision
