#include "vision/stereo/pyramid.h"

#include <algorithm>
#include <cstddef>

#include "core/check.h"

namespace rockyard::vision {

GrayImage ReduceImage(const GrayImage& image, int level) {
  EXPECT(0 <= level && level <= 6);
  if (level == 0) return image;
  const int side = 1 << level;
  const std::uint32_t half = 1U << (2 * level - 1);
  GrayImage out(image.width() >> level, image.height() >> level);
  std::vector<std::uint32_t> columns(static_cast<std::size_t>(out.width()) << level);
  for (int y = 0; y < out.height(); ++y) {
    std::fill(columns.begin(), columns.end(), 0);
    for (int k = 0; k < side; ++k) {
      const std::span<const std::uint8_t> row = image.Row(y * side + k);
      for (std::size_t x = 0; x < columns.size(); ++x) columns[x] += row[x];
    }
    const std::span<std::uint8_t> reduced = out.Row(y);
    for (std::size_t x = 0; x < reduced.size(); ++x) {
      std::uint32_t sum = half;
      for (std::size_t i = x << level; i < (x + 1) << level; ++i) sum += columns[i];
      reduced[x] = static_cast<std::uint8_t>(sum >> (2 * level));
    }
  }
  return out;
}

}  // namespace rockyard::vision
