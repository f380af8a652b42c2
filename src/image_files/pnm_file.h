// PGM and PPM files (Netpbm).
#pragma once

#include <string>
#include <string_view>

#include "image_files/image_limits.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {

// An image of type P2, P3, P5 or P6 with a maximum of 1 to 65535, which is its full scale. `name`
// is what messages call the file. Throws core::UserError: another type, fewer or more pixels than
// the header says, a sample above the maximum, or beyond the limits.
RawImage DecodePnm(std::string_view bytes, const std::string& name, const ImageLimits& limits);

}  // namespace rockyard::image_files
