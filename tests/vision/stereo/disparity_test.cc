// Disparities beside what a camera did not see, and held against known ones.
#include "vision/stereo/disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

std::int16_t Found(double disparity_px) {
  return static_cast<std::int16_t>(std::lround(disparity_px * kDisparityOne));
}

// Five known pixels, of which four have a disparity, off by 0, 0.5, -1.5 and 4.5 px.
TEST(StereoScore, CountsWhatIsBadAmongWhatIsKnownAndMatched) {
  Image<float> known(6, 1, 10.0F);
  known.At(5, 0) = kUnknown;
  DisparityImage found(6, 1, Found(10.0));
  found.At(1, 0) = Found(10.5);
  found.At(2, 0) = Found(8.5);
  found.At(3, 0) = Found(14.5);
  found.At(4, 0) = Dropped(Drop::kPeak);
  const StereoScore score = ScoreAgainst(known, found);
  EXPECT_EQ(score.known, 5);
  EXPECT_EQ(score.matched, 4);
  EXPECT_DOUBLE_EQ(score.Density(), 0.8);
  // More than 0.5, 1, 2 and 4 px; an error of a threshold itself is not bad.
  EXPECT_EQ(score.bad, (std::array<std::int64_t, 4>{2, 2, 1, 1}));
  EXPECT_DOUBLE_EQ(score.BadShare(1), 0.5);
  EXPECT_DOUBLE_EQ(score.mean_error_px, 3.5 / 4.0);
  EXPECT_DOUBLE_EQ(score.rms_error_px, std::sqrt((0.25 + 2.25 + 20.25) / 4.0));
}

TEST(StereoScore, OfNothingIsNought) {
  const StereoScore unknown = ScoreAgainst(Image<float>(3, 2, kUnknown), DisparityImage(3, 2, 0));
  EXPECT_EQ(unknown.known, 0);
  EXPECT_EQ(unknown.Density(), 0.0);
  const StereoScore unmatched =
      ScoreAgainst(Image<float>(3, 2, 1.0F), DisparityImage(3, 2, Dropped(Drop::kBlob)));
  EXPECT_EQ(unmatched.known, 6);
  EXPECT_EQ(unmatched.BadShare(0), 0.0);
  EXPECT_EQ(unmatched.mean_error_px, 0.0);
}

}  // namespace
}  // namespace rockyard::vision
