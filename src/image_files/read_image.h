// Image files of others: recognized by what they hold, not by their names. Every command that is
// given images reads them here, so that limits and refusals are the same for all. No record depends
// on them, as drives and studies make their own images; results of commands do, and which files
// they refuse (UserError).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "image_files/raw_image.h"

namespace rockyard::image_files {

// Returns the image of a PNG, JPEG, PGM, PPM, PDS3, PDS4 or VICAR file. Throws core::UserError with
// the file, what is wrong and what would be right: no such file, a folder, no permission, empty, of
// no known format, truncated or damaged anywhere, in colours that are not read, or beyond the
// limits. Cost: the file and its samples (2 bytes each) are in memory at once.
RawImage ReadImage(const std::filesystem::path& path, const ImageLimits& limits = {});

// Returns the image of a file of these formats whose bytes are in memory, but for planetary images,
// which are read from their files. `name` is what messages call the file.
RawImage DecodeImage(std::string_view bytes, const std::string& name,
                     const ImageLimits& limits = {});

// Returns the image in words: "1024 x 1024 pixels of 12-bit grey, PDS3".
std::string DescribeImage(const RawImage& image);

// Reads a PGM or PPM image, of type P2, P3, P5 or P6 with a maximum of 1 to 65535, which is its
// full scale. `name` is what messages call the file. Throws core::UserError: another type, fewer or
// more pixels than the header says, a sample above the maximum, or beyond the limits.
RawImage DecodePnm(std::string_view bytes, const std::string& name, const ImageLimits& limits);

// Reads a JPEG image of 8 bits, grey or colour, sequential or progressive, as it is stored: what
// EXIF says of turning it is not heeded. `name` is what messages call the file. Throws
// core::UserError: no complete image, damaged data (where libjpeg would go on with a guess), CMYK,
// arithmetic coding, other than 8 bits, more than kMaxJpegScans scans, or beyond the limits.
RawImage DecodeJpeg(std::string_view bytes, const std::string& name, const ImageLimits& limits);

// The most scans of a progressive JPEG image that are read. A scan can say in a few bytes that
// nothing changes, and costs a pass over all pixels; cameras and programs use about ten.
inline constexpr int kMaxJpegScans = 100;

}  // namespace rockyard::image_files
