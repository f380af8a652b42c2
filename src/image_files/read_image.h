// Image files of others: recognized by what they hold, not by their names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "image_files/image_limits.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {

// The image in a PNG, JPEG, PGM, PPM, PDS3, PDS4 or VICAR file. Throws core::UserError with the
// file, what is wrong and what would be right: no such file, a folder, no permission, empty, of no
// known format, truncated or damaged anywhere, in colours that are not read, or beyond the limits.
// Cost: the file and its samples (2 bytes each) are in memory at once.
RawImage ReadImage(const std::filesystem::path& path, const ImageLimits& limits = {});

// The same of bytes in memory, but for planetary images, which are read from their files. `name`
// is what messages call the file.
RawImage DecodeImage(std::string_view bytes, const std::string& name,
                     const ImageLimits& limits = {});

struct ReadableFormat {
  std::string name;       // "PDS3"
  std::string file_kind;  // "8 and 16 bits, grey and colour"
  bool available = true;
  std::string remedy;  // what to do where it is not available
};

// What this build of the program reads, and what it could.
std::vector<ReadableFormat> ReadableFormats();

// "1024 x 1024 pixels of 12-bit grey, PDS3"
std::string DescribeImage(const RawImage& image);

}  // namespace rockyard::image_files
