#include "vision/stereo/row_matches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "synthetic_pair.h"
#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

constexpr int kWidth = 128;
constexpr int kHeight = 80;
constexpr int kDisparity_px = 10;

Scene MovedScene(double rows) {
  return {.width = kWidth,
          .height = kHeight,
          .disparity = [](double, double) { return double{kDisparity_px}; },
          .left_row = [rows](double, double y) { return y - rows; },
          .number = 300};
}

RowMatchOptions SmallGrid() { return {.grid_columns = 14, .grid_rows = 8}; }

std::vector<RowMatch> MatchesOf(const Scene& scene, const RowMatchOptions& options = SmallGrid()) {
  const SyntheticPair pair = MakePair(scene);
  return FindRowMatches(pair.left, pair.right, options);
}

TEST(RowMatches, LieWhereTheRowsWereMovedTo) {
  for (const double rows : {-4.0, 3.25, 7.5}) {
    const std::vector<RowMatch> matches = MatchesOf(MovedScene(rows));
    EXPECT_GT(matches.size(), 60U) << rows;
    double sum = 0.0;
    for (const RowMatch& match : matches) {
      EXPECT_EQ(match.right_column, match.left_column - kDisparity_px);
      EXPECT_NEAR(match.right_row - match.left_row, rows, 0.3);
      sum += match.right_row - match.left_row - rows;
    }
    EXPECT_NEAR(sum / static_cast<double>(matches.size()), 0.0, 0.05) << rows;
  }
}

// One point a cell, in it, with its window in the image; by rows of the grid.
TEST(RowMatches, AreOneACell) {
  const RowMatchOptions options{.grid_columns = 8, .grid_rows = 5};
  int last = -1;
  for (const RowMatch& match : MatchesOf(MovedScene(1.0), options)) {
    const int cell = match.left_row * 5 / kHeight * 8 + match.left_column * 8 / kWidth;
    EXPECT_GT(cell, last);
    last = cell;
    EXPECT_GE(match.left_column, 7);
    EXPECT_LE(match.left_column, kWidth - 8);
    EXPECT_GE(match.left_row, 7);
    EXPECT_LE(match.left_row, kHeight - 8);
  }
  EXPECT_GT(last, 30);
}

// A cell is flat but for a few columns of texture: the point lies among them.
TEST(RowMatches, AreWhereTheTextureIs) {
  SyntheticPair pair = MakePair(MovedScene(0.0));
  ForEachPixel(kWidth, kHeight, [&](int x, int y) {
    if (x >= 60 && x < 84) return;
    pair.left.At(x, y) = 110;
    if (x >= kDisparity_px) pair.right.At(x - kDisparity_px, y) = 110;
  });
  const RowMatchOptions options{.grid_columns = 1, .grid_rows = 4};
  const std::vector<RowMatch> matches = FindRowMatches(pair.left, pair.right, options);
  EXPECT_EQ(matches.size(), 4U);
  for (const RowMatch& match : matches) EXPECT_NEAR(match.left_column, 72, 6);
}

// At the last row that is searched a place has one neighbour only. Columns likewise.
TEST(RowMatches, EndWithinWhatIsSearched) {
  EXPECT_LT(MatchesOf(MovedScene(12.0)).size(), 5U);
  EXPECT_LT(MatchesOf(MovedScene(-12.0)).size(), 5U);
  EXPECT_GT(MatchesOf(MovedScene(11.0)).size(), 40U);
  const SyntheticPair pair = MakePair(MovedScene(0.0));
  const auto count = [&](int least, int most) {
    RowMatchOptions options = SmallGrid();
    options.min_disparity_px = least;
    options.max_disparity_px = most;
    return FindRowMatches(pair.left, pair.right, options).size();
  };
  EXPECT_LT(count(-4, kDisparity_px), 5U);
  EXPECT_LT(count(kDisparity_px, 20), 5U);
  EXPECT_GT(count(kDisparity_px - 1, kDisparity_px + 1), 60U);
}

// Waves of 16 px in both directions repeat within the columns that are searched. (Near the edges of
// the image the difference of Gaussians does not.)
TEST(RowMatches, AreUnique) {
  const GrayImage waves = ImageOf(kWidth, kHeight, [](int x, int y) {
    const double phase = 2.0 * std::numbers::pi / 16.0;
    return std::lround(110.0 + 40.0 * std::sin(phase * x) * std::sin(phase * y));
  });
  RowMatchOptions one_wave = SmallGrid();
  one_wave.min_disparity_px = -20;
  one_wave.max_disparity_px = 20;
  for (const RowMatch& match : FindRowMatches(waves, waves, one_wave)) {
    EXPECT_TRUE(match.left_column < 13 || match.left_column >= kWidth - 13 || match.left_row < 13 ||
                match.left_row >= kHeight - 13)
        << match.left_column << ", " << match.left_row;
  }
  one_wave.max_rows_px = 4;  // control
  one_wave.min_disparity_px = -4;
  one_wave.max_disparity_px = 4;
  EXPECT_GT(FindRowMatches(waves, waves, one_wave).size(), 80U);
}

// The left image shows columns 20 ... 64 once more at 65 ... 109, the right one does not: both find
// the same place, which finds the first.
TEST(RowMatches, FindEachOther) {
  Scene scene = MovedScene(0.0);
  scene.disparity = [](double, double) { return 0.0; };
  scene.noise = 0.0;
  SyntheticPair pair = MakePair(scene);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 65; x < 110; ++x) pair.left.At(x, y) = pair.left.At(x - 45, y);
  }
  RowMatchOptions options = SmallGrid();
  options.max_disparity_px = 50;
  int first = 0;
  for (const RowMatch& match : FindRowMatches(pair.left, pair.right, options)) {
    if (match.left_column < 52) ++first;
    // Windows with what is filtered in them lie in the second showing.
    EXPECT_FALSE(match.left_column >= 65 + 13 && match.left_column < 110 - 13)
        << match.left_column << " at " << match.right_column;
  }
  EXPECT_GT(first, 30);
}

TEST(RowMatches, NeedRoomForWindows) {
  EXPECT_TRUE(FindRowMatches(GrayImage(), GrayImage(), {}).empty());
  const GrayImage small(14, 40, 7);
  EXPECT_TRUE(FindRowMatches(small, small, {}).empty());
}

}  // namespace
}  // namespace rockyard::vision
