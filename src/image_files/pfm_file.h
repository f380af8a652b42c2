// PFM files: one real number a pixel.
#pragma once

#include <string>
#include <string_view>

#include "image_files/raw_image.h"
#include "vision/image.h"

namespace rockyard::image_files {

// Whether a file begins as PFM files do, of one channel or three.
inline bool IsPfm(std::string_view bytes) {
  return bytes.starts_with("Pf") || bytes.starts_with("PF");
}

// The bytes of a PFM file: "Pf", little-endian, the lowest row first. What is not finite is written
// as +infinity, as in the Middlebury stereo data sets, where it means unknown. Not empty.
std::string EncodePfm(const vision::Image<float>& image);

// The values of a PFM file of one channel, of either byte order; what is not finite comes as NaN.
// The size of the scale in its header is not heeded, as in those data sets: only its sign counts.
// `name` is what messages call the file. Throws core::UserError: three channels, fewer or more
// pixels than the header says, or beyond the limits.
vision::Image<float> DecodePfm(std::string_view bytes, const std::string& name,
                               const ImageLimits& limits);

}  // namespace rockyard::image_files
