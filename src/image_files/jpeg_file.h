// JPEG files (libjpeg).
#pragma once

#include <string>
#include <string_view>

#include "image_files/image_limits.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {

// An image of 8 bits, grey or colour, sequential or progressive, as it is stored: what EXIF says of
// turning it is not heeded. `name` is what messages call the file. Throws core::UserError: no
// complete image, damaged data (where libjpeg would go on with a guess), CMYK, arithmetic coding,
// other than 8 bits, more than kMaxJpegScans scans, or beyond the limits.
RawImage DecodeJpeg(std::string_view bytes, const std::string& name, const ImageLimits& limits);

// A scan of a progressive image can say in a few bytes that nothing changes, and costs a pass over
// all pixels; cameras and programs use about ten.
inline constexpr int kMaxJpegScans = 100;

}  // namespace rockyard::image_files
