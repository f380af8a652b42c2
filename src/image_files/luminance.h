// From the samples of a file to 8 bits of grey, which is what stereo takes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "image_files/raw_image.h"
#include "vision/image.h"

namespace rockyard::image_files {

struct GrayOptions {
  // The sample that becomes 255: 1 to 65535. Without it the full scale of the file.
  std::optional<int> white;
};

struct GrayConversion {
  vision::GrayImage image;
  int white = 255;            // the sample that became 255
  std::int64_t clipped = 0;   // pixels of a luminance above white, which became 255 too
  std::string what_was_done;  // in words: "luminance of colour (ITU-R BT.601); ..."
  // Of samples of more than 8 bits that all lie in the lowest eighth of the file's full scale, of
  // which 8 bits keep little: in words, the white that would keep more. Else empty.
  std::string advice;
};

// grey = round(255 min(Y, white) / white), halves up, with Y the grey sample itself, or of colour
//   Y = 0.299 R + 0.587 G + 0.114 B     (ITU-R BT.601-7, section 2.5.1)
// computed exactly, so that 8-bit grey at full scale stays as it is. Red, green and blue are taken
// as they are coded, as BT.601 and the Y of JPEG files are defined; no gamma is undone.
GrayConversion ToGray(const RawImage& image, const GrayOptions& options = {});

}  // namespace rockyard::image_files
