// What is said of files that are no images, or none that can be read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "image_files/raw_image.h"

namespace rockyard::image_files {

// Each throws core::UserError about the file `name`.

// Its pixels cannot be trusted. `reason` continues "is damaged: ".
[[noreturn]] void FailDamaged(const std::string& name, std::string_view reason);

// Some of it is missing.
[[noreturn]] void FailTruncated(const std::string& name);

// A file in order that this program does not read. `reason` is a predicate: "is in CMYK".
[[noreturn]] void FailUnsupported(const std::string& name, const std::string& reason,
                                  const std::string& suggestion);

// Where a side is below 1, or the image is beyond the limits.
void CheckSize(const std::string& name, std::int64_t width, std::int64_t height,
               const ImageLimits& limits);

}  // namespace rockyard::image_files
