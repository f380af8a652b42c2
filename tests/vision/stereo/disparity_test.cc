// What becomes of disparities: beside what a camera did not see, of images that say nothing, as
// maps of elevations, and held against known ones.
#include "vision/stereo/disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "synthetic_pair.h"
#include "vision/each_pixel.h"
#include "vision/stereo/elevation_map.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

using Eigen::Vector3d;

// Disparities beside what a camera did not see, and held against known ones.

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

// What the filters do with images that say nothing, or too much: documented in
// src/vision/README.md.

constexpr int kHardWidth = 160;
constexpr int kHardHeight = 90;
constexpr int kInside =
    (kHardWidth - 6) * (kHardHeight - 6);  // pixels whose windows of 7 x 7 are inside

std::int64_t Count(const DropCounts& counts, Drop drop) {
  return counts[static_cast<std::size_t>(drop)];
}

Scene SmallScene(std::uint32_t number) {
  return {.width = kHardWidth, .height = kHardHeight, .number = number};
}

// All scores are 0: the smallest disparity wins in the left image, and in the right one.
TEST(HardImagesTest, FlatImagesHaveNoPeak) {
  for (const int level : {0, 128, 255}) {
    const GrayImage flat(kHardWidth, kHardHeight, static_cast<std::uint8_t>(level));
    const DropCounts counts = CountDrops(MatchStereo(flat, flat, Range(-4, 16)));
    EXPECT_EQ(Count(counts, Drop::kNone), 0) << level;
    EXPECT_EQ(Count(counts, Drop::kOutside), kHardWidth * kHardHeight - kInside) << level;
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
  EXPECT_GT(Count(CountDrops(found), Drop::kNone), kInside * 98 / 100);
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
  const auto stripes = [&](double from_px) {
    return ImageOf(kHardWidth, kHardHeight, [&](int x, int) {
      return std::lround(120.0 + 60.0 * std::sin(6.283185307 * (x + from_px) / kPeriod_px));
    });
  };
  const GrayImage left = stripes(0.0);
  const GrayImage right = stripes(13.0);  // disparity 13
  const DisparityImage found = MatchStereo(left, right, Range(0, 32));
  int at_true = 0, at_first = 0;
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
  int inside = 0, outside = 0;
  for (int y = 4; y < kHardHeight - 4; ++y) {
    for (int x = 30; x < kHardWidth - 4; ++x) {
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

// Ahead is x, up is z: so right is -y.
std::vector<Vector3d> Slope() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 100; ++j) {
      const double x_m = 2.0 + 0.01 * (i + 0.5);
      const double y_m = -0.5 + 0.01 * (j + 0.5);
      points.emplace_back(x_m, y_m, 0.1 * x_m - 0.3 * y_m);
    }
  }
  return points;
}

TEST(ElevationMap, HoldsTheHeightsOfAPlane) {
  const std::vector<Vector3d> points = Slope();
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), Vector3d::UnitZ(), 0.1);
  EXPECT_EQ(grid.right, -Vector3d::UnitY());
  EXPECT_EQ(grid.columns, 10);
  EXPECT_EQ(grid.rows, 20);
  EXPECT_NEAR(grid.away_from_m, 2.0, 1e-9);
  EXPECT_NEAR(grid.right_from_m, -0.5, 1e-9);
  const Image<float> heights_m = ElevationMap(points, grid);
  ForEachPixel(grid.columns, grid.rows, [&](int column, int row) {
    // The last row is nearest, column 0 is far to the left: at the largest y.
    const double x_m = 2.0 + 0.1 * (grid.rows - 1 - row + 0.5);
    const double y_m = 0.5 - 0.1 * (column + 0.5);
    EXPECT_NEAR(heights_m.At(column, row), 0.1 * x_m - 0.3 * y_m, 1e-6);
  });
}

TEST(ElevationMap, HeightsCountUpwardsWhereTheFramePointsDown) {
  const std::vector<Vector3d> points{{1.05, 0.05, 2.0}, {1.05, 0.05, 4.0}};
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), -Vector3d::UnitZ(), 0.1);
  EXPECT_EQ(grid.right, Vector3d::UnitY());
  const Image<float> heights_m = ElevationMap(points, grid);
  ASSERT_EQ(heights_m.width(), 1);
  EXPECT_FLOAT_EQ(heights_m.At(0, 0), -3.0F);
}

// One point in a hundred is a wrong match a kilometre away.
TEST(ElevationMap, StrayPointsDoNotWidenTheGrid) {
  std::vector<Vector3d> points = Slope();
  for (int i = 0; i < 100; ++i) points.emplace_back(1000.0, -1000.0, 0.0);
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), Vector3d::UnitZ(), 0.1);
  EXPECT_LE(grid.columns, 11);
  EXPECT_LE(grid.rows, 21);
  const Image<float> heights_m = ElevationMap(points, grid);
  for (const float height_m : heights_m.values()) EXPECT_LT(std::abs(height_m), 1.0F);
}

TEST(ElevationMap, CellsGrowWhereThereWouldBeTooMany) {
  const std::vector<Vector3d> points{{0.0, 0.0, 0.0}, {50.0, 0.0, 0.0}, {100.0, 7.0, 0.0}};
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), Vector3d::UnitZ(), 0.01, 50);
  EXPECT_GE(grid.cell_m, 2.0);
  EXPECT_LE(grid.rows, 50);
  EXPECT_GE(grid.rows, 45);
}

TEST(ElevationMap, CellsWithoutPointsAreUnknown) {
  const std::vector<Vector3d> points{{0.05, 0.05, 1.0}, {0.35, 0.05, 1.0}};
  const ElevationGrid grid = GridOver(points, Vector3d::UnitX(), Vector3d::UnitZ(), 0.1);
  const Image<float> heights_m = ElevationMap(points, grid);
  ASSERT_EQ(heights_m.height(), 4);
  EXPECT_FALSE(std::isnan(heights_m.At(0, 0)));
  EXPECT_TRUE(std::isnan(heights_m.At(0, 1)));
  EXPECT_FALSE(std::isnan(heights_m.At(0, 3)));
}

TEST(ElevationMap, OfNoPointsHasNoCells) {
  const ElevationGrid grid = GridOver({}, Vector3d::UnitX(), Vector3d::UnitZ(), 0.1);
  EXPECT_EQ(grid.columns, 0);
  EXPECT_TRUE(ElevationMap({}, grid).empty());
}

}  // namespace
}  // namespace rockyard::vision
