// Images of coloured pixels.
#pragma once

#include <cstdint>

#include "vision/cameras/camera_model.h"
#include "vision/image.h"

namespace rockyard::vision {

// 8 bits of each primary colour, in the coding of the camera or of the file.
struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

using ColourImage = Image<Rgb>;

// Whether an image has the rows and columns of a camera, and so can be of it.
inline bool HasSizeOf(const ColourImage& image, const CameraModel& camera) {
  return !image.empty() && image.width() == camera.size.columns &&
         image.height() == camera.size.rows;
}

}  // namespace rockyard::vision
