// A change of view about a feature, in whole numbers (window.h).
#pragma once

#include <cstdint>

namespace rockyard::vision {

// How many 1/4096 px a place of the first image moves with a column and a row of the window.
struct Warp {
  static constexpr double kOne = 4096.0;
  static constexpr double kMost = 64.0;  // pixels a pixel
  // From there to 1/256 px, rounded.
  static constexpr int kShift = 4;
  static constexpr std::int32_t kHalf = 1 << (kShift - 1);

  std::int32_t x_by_column = 0;
  std::int32_t x_by_row = 0;
  std::int32_t y_by_column = 0;
  std::int32_t y_by_row = 0;
};

}  // namespace rockyard::vision
