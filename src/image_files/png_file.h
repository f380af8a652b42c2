// PNG files (libpng). Commands and replays write their pictures by it, ReadImage reads by it. No
// record or store holds one: compression is free, pixels are exact.
#pragma once

#include <string>
#include <string_view>

#include "image_files/raw_image.h"
#include "vision/image.h"

namespace rockyard::image_files {

// Returns the bytes of a PNG file of 8 or 16 bits a channel. A file of 16 bits has a gamma of 1, as
// its samples are quantities rather than brightness. No image may be empty. Throws
// std::runtime_error where libpng fails.
std::string EncodePng(const Picture& picture);
std::string EncodePng(const vision::GrayImage& image);
std::string EncodePng(const SamplePlane& image);

// Reads any PNG image: 1 to 16 bits, grey, colour or palette, with or without alpha, interlaced or
// not. `name` is what messages call the file. Throws core::UserError.
RawImage DecodePng(std::string_view bytes, const std::string& name, const ImageLimits& limits);

}  // namespace rockyard::image_files
