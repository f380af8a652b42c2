// What the filters do with images that say nothing, or too much: documented in
// src/vision/README.md.
#include <gtest/gtest.h>

#include <cmath>

#include "synthetic_pair.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 90;
constexpr int kInside = (kWidth - 6) * (kHeight - 6);  // pixels whose windows of 7 x 7 are inside

std::int64_t Count(const DropCounts& counts, Drop drop) {
  return counts[static_cast<std::size_t>(drop)];
}

Scene SmallScene(std::uint32_t number) {
  return {.width = kWidth, .height = kHeight, .number = number};
}

// All scores are 0: the smallest disparity wins in the left image, and in the right one.
TEST(HardImagesTest, FlatImagesHaveNoPeak) {
  for (const int level : {0, 128, 255}) {
    const GrayImage flat(kWidth, kHeight, static_cast<std::uint8_t>(level));
    const DropCounts counts = CountDrops(MatchStereo(flat, flat, Range(-4, 16)));
    EXPECT_EQ(Count(counts, Drop::kNone), 0) << level;
    EXPECT_EQ(Count(counts, Drop::kOutside), kWidth * kHeight - kInside) << level;
    EXPECT_EQ(Count(counts, Drop::kRangeEnd) + Count(counts, Drop::kLineOfSight), kInside);
    EXPECT_GT(Count(counts, Drop::kRangeEnd), kInside * 9 / 10) << level;
  }
}

TEST(HardImagesTest, NoiseWithoutTextureLeavesNearlyNothing) {
  Scene scene = SmallScene(200);
  scene.contrast = 0.0;
  const SyntheticPair pair = MakePair(scene);
  StereoPipelineParams params = Range(0, 32);
  const DropCounts counts = CountDrops(MatchStereo(pair.left, pair.right, params));
  EXPECT_LT(Count(counts, Drop::kNone), kInside / 100);
  // Negative control: a third of the pixels agree with themselves by chance.
  params.filters.min_curvature = 0.0;
  params.filters.min_curvature_ratio = 0.0;
  params.filters.blob_min_px = 0;
  EXPECT_GT(Count(CountDrops(MatchStereo(pair.left, pair.right, params)), Drop::kNone),
            kInside / 5);
}

TEST(HardImagesTest, IdenticalImagesAreInfinitelyFar) {
  const SyntheticPair pair = MakePair(SmallScene(201));
  const DisparityImage found = MatchStereo(pair.left, pair.left, Range(-3, 24));
  const DropCounts counts = CountDrops(found);
  EXPECT_GT(Count(counts, Drop::kNone), kInside * 98 / 100);
  int wrong = 0;
  for (const std::int16_t value : found.values()) {
    // The parabola sees how different the neighbours are, no more.
    wrong += IsValid(value) && std::abs(DisparityPx(value)) > 0.3 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0);
  // With a range that begins at 0, the best match has no neighbour below.
  const DropCounts cut = CountDrops(MatchStereo(pair.left, pair.left, Range(0, 24)));
  EXPECT_LT(Count(cut, Drop::kNone), kInside / 20);
  EXPECT_GT(Count(cut, Drop::kRangeEnd), kInside * 9 / 10);
}

// Stripes of a period within the range match as well one period on: the filters cannot know. Right
// and left agree, as both take the smallest disparity of equal scores.
TEST(HardImagesTest, RepeatedTextureMatchesAPeriodOff) {
  constexpr double kPeriod_px = 9.0;
  GrayImage left(kWidth, kHeight);
  GrayImage right(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto grey = [&](double at) {
        return static_cast<std::uint8_t>(
            std::lround(120.0 + 60.0 * std::sin(6.283185307 * at / kPeriod_px)));
      };
      left.At(x, y) = grey(x);
      right.At(x, y) = grey(x + 13.0);  // disparity 13
    }
  }
  const DisparityImage found = MatchStereo(left, right, Range(0, 32));
  int at_true = 0;
  int at_first = 0;
  for (const std::int16_t value : found.values()) {
    if (!IsValid(value)) continue;
    at_true += std::abs(DisparityPx(value) - 13.0) < 0.5 ? 1 : 0;
    at_first += std::abs(DisparityPx(value) - 4.0) < 0.5 ? 1 : 0;
  }
  EXPECT_GT(at_first, kInside * 8 / 10);
  EXPECT_LT(at_true, kInside / 100);
}

TEST(HardImagesTest, SaturatedPartsAreDroppedAndTheRestIsNot) {
  Scene scene = SmallScene(202);
  scene.disparity = [](double, double) { return 8.0; };
  SyntheticPair pair = MakePair(scene);
  for (int y = 20; y < 70; ++y) {
    for (int x = 60; x < 120; ++x) {
      pair.left.At(x, y) = 255;
      pair.right.At(x - 8, y) = 255;
    }
  }
  const DisparityImage found = MatchStereo(pair.left, pair.right, Range(0, 24));
  int inside = 0;
  int outside = 0;
  for (int y = 4; y < kHeight - 4; ++y) {
    for (int x = 30; x < kWidth - 4; ++x) {
      const bool deep = x >= 70 && x < 110 && y >= 30 && y < 60;
      const bool far = x < 50 || x >= 130 || y < 10 || y >= 80;
      inside += deep && IsValid(found.At(x, y)) ? 1 : 0;
      outside += far && !IsValid(found.At(x, y)) ? 1 : 0;
    }
  }
  EXPECT_EQ(inside, 0);
  EXPECT_LT(outside, 60);
}

TEST(HardImagesTest, SwappedEyesFindNothingMuch) {
  Scene scene = SmallScene(203);
  scene.disparity = [](double, double y) { return 8.0 + 0.1 * y; };
  const SyntheticPair pair = MakePair(scene);
  const auto count = [&](const GrayImage& left, const GrayImage& right) {
    return Count(CountDrops(MatchStereo(left, right, Range(0, 32))), Drop::kNone);
  };
  EXPECT_GT(count(pair.left, pair.right), kInside * 7 / 10);
  EXPECT_LT(count(pair.right, pair.left), kInside / 50);
}

TEST(HardImagesTest, EmptyAndTinyImages) {
  EXPECT_TRUE(MatchStereo(GrayImage(), GrayImage(), {}).empty());
  const DropCounts counts = CountDrops(MatchStereo(GrayImage(5, 40, 9), GrayImage(5, 40, 9), {}));
  EXPECT_EQ(Count(counts, Drop::kOutside), 200);
}

}  // namespace
}  // namespace rockyard::vision
