// How large an image may be.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rockyard::image_files {

// Checked against what the header of a file says, before memory is taken for pixels.
struct ImageLimits {
  int max_side = 16384;
  std::int64_t max_pixels = std::int64_t{1} << 26;  // 67 million: 400 MB of three colours
};

// No image within the limits needs more: P3 with 16 bits has up to 6 characters a sample.
inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 31;

}  // namespace rockyard::image_files
