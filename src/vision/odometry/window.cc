#include "vision/odometry/window.h"

#include <algorithm>
#include <cstring>

#include "core/check.h"

namespace rockyard::vision {

namespace {

constexpr int kSide = 15;

// Copies 15 bytes as two words that overlap, since a 16th may lie behind the image, and writes 0 as
// the 16th.
void CopyFifteen(const std::uint8_t* from, std::uint8_t* to) {
  std::memcpy(to, from, 8);
  std::memcpy(to + 7, from + 7, 8);
  to[15] = 0;
}

}  // namespace

void CopyWindow(const GrayImage& image, const Feature& feature, int side, std::uint8_t* window) {
  EXPECT(side > 0 && side % 2 == 1 && side <= kSide);
  const int reach = side / 2;
  EXPECT(feature.column >= reach && feature.column + reach < image.width());
  EXPECT(feature.row >= reach && feature.row + reach < image.height());
  const std::uint8_t* from = &image.At(feature.column - reach, feature.row - reach);
  const auto step = static_cast<std::size_t>(image.width());
  std::uint8_t* const end = window + kWindowBytes;
  std::uint8_t* to = window;
  for (int row = 0; row < side; ++row, from += step, to += kWindowStride) {
    if (side == kSide) {
      CopyFifteen(from, to);
    } else {
      std::fill_n(std::copy_n(from, side, to), static_cast<int>(kWindowStride) - side,
                  std::uint8_t{0});
    }
  }
  std::fill(to, end, std::uint8_t{0});
}

}  // namespace rockyard::vision
