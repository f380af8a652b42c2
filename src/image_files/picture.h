// Pictures of coloured pixels.
#pragma once

#include <cstdint>

#include "vision/image.h"

namespace rockyard::image_files {

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  bool operator==(const Rgb&) const = default;
};

using Picture = vision::Image<Rgb>;

}  // namespace rockyard::image_files
