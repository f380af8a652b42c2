// Places of a window's pixels in another view, in numbers of 32 bits (window_samples.h).
#pragma once

#include <array>
#include <cstddef>

namespace rockyard::vision {

// The window and a pixel about it, row by row.
inline constexpr int kWideReach = 8;
inline constexpr std::size_t kWideSide = 2 * kWideReach + 1;
// Whole vectors of up to 16 lanes: what comes behind the last pixel repeats the middle.
inline constexpr std::size_t kWidePixels = (kWideSide * kWideSide + 15) / 16 * 16;

struct WideOffsets {
  std::array<float, kWidePixels> across{};
  std::array<float, kWidePixels> down{};
};

inline constexpr WideOffsets kWideOffsets = [] {
  WideOffsets offsets;
  for (std::size_t i = 0; i < kWideSide * kWideSide; ++i) {
    const std::size_t row = i / kWideSide;
    offsets.across[i] = static_cast<float>(i % kWideSide) - static_cast<float>(kWideReach);
    offsets.down[i] = static_cast<float>(row) - static_cast<float>(kWideReach);
  }
  return offsets;
}();

// ViewChange about a pixel: (x, y) + (by_column across + by_row down) / (1 + near).
struct WindowView {
  float x;
  float y;
  float x_by_column;
  float x_by_row;
  float y_by_column;
  float y_by_row;
  float near_by_column;
  float near_by_row;
};

}  // namespace rockyard::vision
