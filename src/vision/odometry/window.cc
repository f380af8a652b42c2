#include "vision/odometry/window.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/check.h"

namespace rockyard::vision {

void CopyWindow(const GrayImage& image, const Feature& feature, int side, std::uint8_t* window) {
  EXPECT(side > 0 && side % 2 == 1 && side < static_cast<int>(kWindowStride));
  const int reach = side / 2;
  std::fill_n(window, kWindowBytes, std::uint8_t{0});
  for (int row = 0; row < side; ++row) {
    const std::uint8_t* const from = &image.At(feature.column - reach, feature.row - reach + row);
    std::memcpy(window + static_cast<std::size_t>(row) * kWindowStride, from,
                static_cast<std::size_t>(side));
  }
}

void WarpWindow(const GrayImage& image, const Pixel& middle, const Eigen::Matrix2d& by_offset,
                int side, std::uint8_t* window) {
  EXPECT(side > 0 && side % 2 == 1 && side < static_cast<int>(kWindowStride));
  constexpr int kShift = 8;
  constexpr int kOne = 1 << kShift;
  const int reach = side / 2;
  const auto clamped = [&](int x, int y) {
    return static_cast<int>(
        image.At(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1)));
  };
  std::fill_n(window, kWindowBytes, std::uint8_t{0});
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const Pixel at = middle + by_offset * Pixel(column, row);
      const auto x = static_cast<int>(std::floor(at.x() * kOne + 0.5));
      const auto y = static_cast<int>(std::floor(at.y() * kOne + 0.5));
      const int left = x >> kShift;
      const int top = y >> kShift;
      const int u = x - (left << kShift);
      const int v = y - (top << kShift);
      const int above = clamped(left, top) * (kOne - u) + clamped(left + 1, top) * u;
      const int below = clamped(left, top + 1) * (kOne - u) + clamped(left + 1, top + 1) * u;
      const int grey = (above * (kOne - v) + below * v + (1 << (2 * kShift - 1))) >> (2 * kShift);
      window[static_cast<std::size_t>(row + reach) * kWindowStride +
             static_cast<std::size_t>(column + reach)] = static_cast<std::uint8_t>(grey);
    }
  }
}

}  // namespace rockyard::vision
