// Images of coloured pixels.
#pragma once

#include <cstdint>

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

}  // namespace rockyard::vision
