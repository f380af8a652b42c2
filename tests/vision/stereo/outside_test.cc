#include "vision/stereo/outside.h"

#include <gtest/gtest.h>

#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

constexpr int kWidth = 24;
constexpr int kHeight = 12;

Image<std::uint8_t> Everywhere() { return Image<std::uint8_t>(kWidth, kHeight, 1); }

// Pixel by pixel over the window at side / 2, from the definition.
bool WindowHasOutside(const Image<std::uint8_t>& inside, int x, int y, int side) {
  for (int v = y - side / 2; v < y - side / 2 + side; ++v) {
    for (int u = x - side / 2; u < x - side / 2 + side; ++u) {
      if (u < 0 || v < 0 || u >= inside.width() || v >= inside.height()) continue;
      if (inside.At(u, v) == 0) return true;
    }
  }
  return false;
}

TEST(DropOutside, DropsWhatItsWindowOrThatOfItsMatchReachesOutOf) {
  Image<std::uint8_t> left = Everywhere();
  Image<std::uint8_t> right = Everywhere();
  left.At(5, 3) = 0;
  left.At(23, 11) = 0;
  right.At(9, 8) = 0;
  right.At(0, 0) = 0;
  for (const int side : {1, 2, 3, 6, 7}) {
    for (const int disparity_px : {-2, 0, 4}) {
      const auto stored = static_cast<std::int16_t>(disparity_px * kDisparityOne);
      DisparityImage disparities(kWidth, kHeight, stored);
      DropOutside(left, right, side, disparities);
      ForEachPixel(kWidth, kHeight, [&](int x, int y) {
        const bool dropped = WindowHasOutside(left, x, y, side) ||
                             WindowHasOutside(right, x - disparity_px, y, side);
        EXPECT_EQ(disparities.At(x, y), dropped ? Dropped(Drop::kOutside) : stored)
            << x << ", " << y << ", window " << side << ", disparity " << disparity_px;
      });
    }
  }
}

TEST(DropOutside, LeavesWhatOtherFiltersDropped) {
  DisparityImage disparities(kWidth, kHeight, Dropped(Drop::kBlob));
  DropOutside(Image<std::uint8_t>(kWidth, kHeight, 0), Everywhere(), 7, disparities);
  EXPECT_EQ(disparities, DisparityImage(kWidth, kHeight, Dropped(Drop::kBlob)));
}

// The match of a disparity of 3.5 px and less lies 3 px aside only below 3.5.
TEST(DropOutside, TakesTheNearestWholePixelOfTheMatch) {
  Image<std::uint8_t> right = Everywhere();
  right.At(7, 5) = 0;
  DisparityImage disparities(kWidth, kHeight, static_cast<std::int16_t>(3 * kDisparityOne + 14));
  DropOutside(Everywhere(), right, 1, disparities);
  EXPECT_EQ(DropOf(disparities.At(10, 5)), Drop::kOutside);
  EXPECT_EQ(DropOf(disparities.At(11, 5)), Drop::kNone);
}

}  // namespace
}  // namespace rockyard::vision
