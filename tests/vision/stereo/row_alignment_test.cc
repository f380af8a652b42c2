#include "vision/stereo/row_alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "synthetic_pair.h"
#include "vision/each_pixel.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/row_matches.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

// Pairs whose rows are moved by known amounts as they are made, so that no image is a resampling of
// another one.

constexpr int kWidth = 192;
constexpr int kHeight = 112;
constexpr double kMiddleX = 95.5;
constexpr double kMiddleY = 55.5;

// The left row y of what the right image shows in its row y + offset + per_column (x - middle) +
// per_row (y - middle).
double LeftRow(const RowCorrection& moved, double x, double right_row) {
  return (right_row - moved.offset_px - moved.per_column * (x - kMiddleX) +
          moved.per_row * kMiddleY) /
         (1.0 + moved.per_row);
}

// Ground that rises towards the lower edge: disparities from 14 to 31 px.
Scene MovedScene(std::uint32_t number, const RowCorrection& moved) {
  return {.width = kWidth,
          .height = kHeight,
          .disparity = [](double, double y) { return 14.0 + 0.15 * y; },
          .left_row = [moved](double x, double y) { return LeftRow(moved, x, y); },
          .number = number};
}

RowAlignmentOptions SmallGrid() { return {.search = {.grid_columns = 16, .grid_rows = 10}}; }

core::Result<RowAlignment> Align(const Scene& scene,
                                 const RowAlignmentOptions& options = SmallGrid()) {
  const SyntheticPair pair = MakePair(scene);
  return FindRowAlignment(pair.left, pair.right, options);
}

// The largest error of the row over the corners of the image.
double Error_px(const RowCorrection& found, const RowCorrection& moved) {
  double most = 0.0;
  for (const double x : {0.0, kWidth - 1.0}) {
    for (const double y : {0.0, kHeight - 1.0}) {
      const double truth =
          y + moved.offset_px + moved.per_column * (x - kMiddleX) + moved.per_row * (y - kMiddleY);
      most = std::max(most, std::abs(found.RightRow(x, y, kWidth, kHeight) - truth));
    }
  }
  return most;
}

std::string Reason(const core::Result<RowAlignment>& result) {
  return result.ok() ? "" : result.problems().front().reason;
}

TEST(RowAlignment, FindsHowRowsWereMoved) {
  std::uint32_t number = 400;
  RowAlignmentOptions options;
  options.search.grid_rows = 14;
  for (const RowCorrection& moved :
       {RowCorrection{0.0, 0.0, 0.0}, RowCorrection{3.3, 0.0, 0.0}, RowCorrection{-5.5, 0.03, 0.0},
        RowCorrection{1.2, 0.0, -0.03}, RowCorrection{-2.25, -0.02, 0.02}}) {
    const auto found = Align(MovedScene(number++, moved), options);
    ASSERT_TRUE(found.ok()) << Reason(found);
    EXPECT_LT(Error_px(found->correction, moved), 0.1) << moved.offset_px;
    EXPECT_GT(found->agreeing, 80);
    EXPECT_GE(found->matches, found->agreeing);
    EXPECT_LT(found->rms_px, 0.25);
    EXPECT_GT(found->rms_px, 0.005);
  }
}

TEST(RowAlignment, BearsEyesOfDifferentBrightness) {
  const RowCorrection moved{-3.4, 0.01, -0.01};
  Scene scene = MovedScene(410, moved);
  scene.right_gain = 0.85;
  scene.right_offset = 40.0;
  scene.noise = 3.0;
  const auto found = Align(scene);
  ASSERT_TRUE(found.ok()) << Reason(found);
  EXPECT_LT(Error_px(found->correction, moved), 0.1);
}

// The left third of the right image lies 6 rows further down than the rest tells.
TEST(RowAlignment, IsNotPulledByAThirdThatIsWrong) {
  const RowCorrection moved{-2.0, 0.01, 0.01};
  Scene scene = MovedScene(411, moved);
  scene.left_row = [moved](double x, double y) {
    return LeftRow(moved, x, y) - (x < kWidth / 3 ? 6.0 : 0.0);
  };
  const auto found = Align(scene);
  ASSERT_TRUE(found.ok()) << Reason(found);
  EXPECT_LT(Error_px(found->correction, moved), 0.1);
  EXPECT_LT(found->agreeing, 0.85 * found->matches);
}

// Three parts that lie 8 rows from each other in no order: no plane has half of the matches.
TEST(RowAlignment, FailsWhereMatchesDisagree) {
  Scene scene = MovedScene(412, {});
  scene.left_row = [](double x, double y) { return y + (x < 55.0 ? 8.0 : x < 110.0 ? -8.0 : 0.0); };
  EXPECT_NE(Reason(Align(scene)).find("agree on how the rows lie"), std::string::npos);
  RowAlignmentOptions options = SmallGrid();  // control
  options.min_share = 0.2;
  EXPECT_TRUE(Align(scene, options).ok());
}

TEST(RowAlignment, FailsWhereImagesShowNothingInCommon) {
  Scene noise = MovedScene(413, {});
  noise.contrast = 0.0;
  EXPECT_NE(Reason(Align(noise)).find("fewer than the 20"), std::string::npos);
  const GrayImage blank(kWidth, kHeight, 90);
  EXPECT_EQ(Reason(FindRowAlignment(blank, blank, SmallGrid())),
            "has 0 points that are found in the left image too, fewer than the 20 that are needed");
  const GrayImage left = MakePair(MovedScene(414, {})).left;
  const GrayImage other = MakePair(MovedScene(415, {})).right;
  EXPECT_FALSE(FindRowAlignment(left, other, SmallGrid()).ok());
}

TEST(RowAlignment, FailsWhereRowsLieBeyondTheSearch) {
  const Scene scene = MovedScene(416, {20.0, 0.0, 0.0});
  EXPECT_FALSE(Align(scene).ok());
  RowAlignmentOptions options = SmallGrid();
  options.search.max_rows_px = 24;
  const auto found = Align(scene, options);
  ASSERT_TRUE(found.ok()) << Reason(found);
  EXPECT_LT(Error_px(found->correction, {20.0, 0.0, 0.0}), 0.1);
}

TEST(RowAlignment, FailsForImagesOfDifferentSizes) {
  EXPECT_EQ(Reason(FindRowAlignment(GrayImage(40, 30), GrayImage(40, 31), {})),
            "is 40 x 31 pixels, the left one 40 x 30");
}

// Texture in a band of 12 rows, a point a column of the grid: how rows move from top to bottom is
// open.
TEST(RowAlignment, FailsWhereMatchesLieAlongALine) {
  SyntheticPair pair = MakePair(MovedScene(417, {}));
  for (int y = 0; y < kHeight; ++y) {
    if (y >= 50 && y < 62) continue;
    for (int x = 0; x < kWidth; ++x) pair.left.At(x, y) = pair.right.At(x, y) = 110;
  }
  RowAlignmentOptions options = SmallGrid();
  options.search.grid_rows = 1;
  options.min_agreeing = 10;
  EXPECT_NE(Reason(FindRowAlignment(pair.left, pair.right, options)).find("along a line"),
            std::string::npos);
}

StereoScore Score(const SyntheticPair& pair, const GrayImage& right,
                  const Image<std::uint8_t>& inside) {
  StereoPipelineParams params;
  params.correlator.min_disparity_px = 8;
  DisparityImage found = MatchStereo(pair.left, right, params);
  DropOutside(Image<std::uint8_t>(kWidth, kHeight, 1), inside, 7, found);
  Image<float> known(kWidth, kHeight);
  std::copy(pair.truth.values().begin(), pair.truth.values().end(), known.values().begin());
  return ScoreAgainst(known, found);
}

TEST(RowTable, MakesAMovedPairAsGoodAsAnAlignedOne) {
  const RowCorrection moved{2.6, 0.015, -0.01};
  const Image<std::uint8_t> everywhere(kWidth, kHeight, 1);
  const SyntheticPair aligned = MakePair(MovedScene(418, {}));
  const StereoScore best = Score(aligned, aligned.right, everywhere);
  const SyntheticPair pair = MakePair(MovedScene(418, moved));
  const auto found = FindRowAlignment(pair.left, pair.right, SmallGrid());
  ASSERT_TRUE(found.ok()) << Reason(found);
  const RectificationTable table = MakeRowTable(found->correction, kWidth, kHeight);
  const StereoScore corrected = Score(pair, table.Rectify(pair.right), table.Inside());
  EXPECT_GT(corrected.Density(), best.Density() - 0.06);  // of which the rows outside are a half
  EXPECT_LT(corrected.BadShare(1), best.BadShare(1) + 0.005);
  EXPECT_LT(corrected.rms_error_px, 1.5 * best.rms_error_px);
  const StereoScore without = Score(pair, pair.right, everywhere);  // control
  EXPECT_LT(without.Density(), 0.6 * best.Density());
}

// 3 rows down: the last three output rows have no source; other places are exact.
TEST(RowTable, TakesWholeRowsAsTheyAre) {
  const GrayImage image = ImageOf(kWidth, kHeight, [](int x, int y) { return 7 * x + 31 * y; });
  const RectificationTable table = MakeRowTable({3.0, 0.0, 0.0}, kWidth, kHeight);
  const GrayImage moved = table.Rectify(image);
  const Image<std::uint8_t> inside = table.Inside();
  ForEachPixel(kWidth, kHeight, [&](int x, int y) {
    ASSERT_EQ(inside.At(x, y), y < kHeight - 3 ? 1 : 0);
    ASSERT_EQ(moved.At(x, y), y < kHeight - 3 ? image.At(x, y + 3) : 0);
  });
}

constexpr int kSmallWidth = 128;
constexpr int kSmallHeight = 80;
constexpr int kDisparity_px = 10;

Scene ShiftedScene(double rows) {
  return {.width = kSmallWidth,
          .height = kSmallHeight,
          .disparity = [](double, double) { return double{kDisparity_px}; },
          .left_row = [rows](double, double y) { return y - rows; },
          .number = 300};
}

RowMatchOptions MatchGrid() { return {.grid_columns = 14, .grid_rows = 8}; }

std::vector<RowMatch> MatchesOf(const Scene& scene, const RowMatchOptions& options = MatchGrid()) {
  const SyntheticPair pair = MakePair(scene);
  return FindRowMatches(pair.left, pair.right, options);
}

TEST(RowMatches, LieWhereTheRowsWereMovedTo) {
  for (const double rows : {-4.0, 3.25, 7.5}) {
    const std::vector<RowMatch> matches = MatchesOf(ShiftedScene(rows));
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
  for (const RowMatch& match : MatchesOf(ShiftedScene(1.0), options)) {
    const int cell = match.left_row * 5 / kSmallHeight * 8 + match.left_column * 8 / kSmallWidth;
    EXPECT_GT(cell, last);
    last = cell;
    EXPECT_GE(match.left_column, 7);
    EXPECT_LE(match.left_column, kSmallWidth - 8);
    EXPECT_GE(match.left_row, 7);
    EXPECT_LE(match.left_row, kSmallHeight - 8);
  }
  EXPECT_GT(last, 30);
}

// A cell is flat but for a few columns of texture: the point lies among them.
TEST(RowMatches, AreWhereTheTextureIs) {
  SyntheticPair pair = MakePair(ShiftedScene(0.0));
  ForEachPixel(kSmallWidth, kSmallHeight, [&](int x, int y) {
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
  EXPECT_LT(MatchesOf(ShiftedScene(12.0)).size(), 5U);
  EXPECT_LT(MatchesOf(ShiftedScene(-12.0)).size(), 5U);
  EXPECT_GT(MatchesOf(ShiftedScene(11.0)).size(), 40U);
  const SyntheticPair pair = MakePair(ShiftedScene(0.0));
  const auto count = [&](int least, int most) {
    RowMatchOptions options = MatchGrid();
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
  const GrayImage waves = ImageOf(kSmallWidth, kSmallHeight, [](int x, int y) {
    const double phase = 2.0 * std::numbers::pi / 16.0;
    return std::lround(110.0 + 40.0 * std::sin(phase * x) * std::sin(phase * y));
  });
  RowMatchOptions one_wave = MatchGrid();
  one_wave.min_disparity_px = -20;
  one_wave.max_disparity_px = 20;
  for (const RowMatch& match : FindRowMatches(waves, waves, one_wave)) {
    EXPECT_TRUE(match.left_column < 13 || match.left_column >= kSmallWidth - 13 ||
                match.left_row < 13 || match.left_row >= kSmallHeight - 13)
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
  Scene scene = ShiftedScene(0.0);
  scene.disparity = [](double, double) { return 0.0; };
  scene.noise = 0.0;
  SyntheticPair pair = MakePair(scene);
  for (int y = 0; y < kSmallHeight; ++y) {
    for (int x = 65; x < 110; ++x) pair.left.At(x, y) = pair.left.At(x - 45, y);
  }
  RowMatchOptions options = MatchGrid();
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
