#include "vision/stereo/disparity.h"

#include <cstddef>

namespace rockyard::vision {

DropCounts CountDrops(const DisparityImage& disparities) {
  DropCounts counts{};
  for (const std::int16_t disparity : disparities.values()) {
    ++counts[static_cast<std::size_t>(DropOf(disparity))];
  }
  return counts;
}

Image<std::uint8_t> DropMask(const DisparityImage& disparities) {
  Image<std::uint8_t> mask(disparities.width(), disparities.height());
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    mask.values()[i] = static_cast<std::uint8_t>(DropOf(disparities.values()[i]));
  }
  return mask;
}

}  // namespace rockyard::vision
