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

}  // namespace rockyard::vision
