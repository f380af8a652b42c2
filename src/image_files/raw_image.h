// What an image file holds, before anything is made of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "vision/colour_image.h"
#include "vision/image.h"

namespace rockyard::image_files {

// How large an image may be: checked against what the header of a file says, before memory is taken
// for pixels.
struct ImageLimits {
  int max_side = 16384;
  std::int64_t max_pixels = std::int64_t{1} << 26;  // 67 million: 400 MB of three colours
};

// No image within the limits needs more: P3 with 16 bits has up to 6 characters a sample.
inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 31;

using Rgb = vision::Rgb;
using Picture = vision::ColourImage;
using SamplePlane = vision::Image<std::uint16_t>;

// Samples as the file has them, in the coding of the file (gamma and all): nothing is scaled but
// grey of fewer than 8 bits in PNG files, which is brought to 8.
struct RawImage {
  std::string format;               // "PNG"
  std::vector<SamplePlane> planes;  // one of grey, or red, green and blue; of equal size, not empty
  int bits = 8;                     // of a sample: 1 to 16
  int full_scale = 255;             // the sample that stands for white: 1 to 65535
  std::string full_scale_from;      // what says so: "8 bits of the format"

  // What was left out.
  bool had_alpha = false;
  std::int64_t not_opaque = 0;  // pixels of less than full alpha; they are read as if they had it
  std::int64_t negative = 0;    // samples below zero, which are read as 0

  int width() const { return planes.front().width(); }
  int height() const { return planes.front().height(); }
  bool is_colour() const { return planes.size() == 3; }
};

}  // namespace rockyard::image_files
