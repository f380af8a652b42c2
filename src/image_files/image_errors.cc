#include "image_files/image_errors.h"

#include <fmt/format.h>

#include "core/error.h"

namespace rockyard::image_files {

void FailDamaged(const std::string& name, std::string_view reason) {
  throw core::UserError(name, fmt::format("is damaged: {}", reason),
                        "copy it again, or make it anew from its source");
}

void FailTruncated(const std::string& name) {
  throw core::UserError(name, "ends before its last pixel",
                        "copy it again: only a part of the file is here");
}

void FailUnsupported(const std::string& name, const std::string& reason,
                     const std::string& suggestion) {
  throw core::UserError(name, reason, suggestion);
}

void CheckSize(const std::string& name, std::int64_t width, std::int64_t height,
               const ImageLimits& limits) {
  if (width < 1 || height < 1) {
    FailDamaged(name, fmt::format("an image of {} x {} pixels has none", width, height));
  }
  const bool too_long = width > limits.max_side || height > limits.max_side;
  if (too_long || width * height > limits.max_pixels) {
    FailUnsupported(
        name,
        fmt::format("has {} x {} pixels, more than the {} a side and {} in all that are read",
                    width, height, limits.max_side, limits.max_pixels),
        "check that this is the right file, and cut out or reduce what is needed");
  }
}

}  // namespace rockyard::image_files
