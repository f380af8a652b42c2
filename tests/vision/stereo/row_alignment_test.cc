// Pairs whose rows are moved by known amounts as they are made, so that no image is a resampling of
// another one.
#include "vision/stereo/row_alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "synthetic_pair.h"
#include "vision/each_pixel.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

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
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      ASSERT_EQ(inside.At(x, y), y < kHeight - 3 ? 1 : 0);
      ASSERT_EQ(moved.At(x, y), y < kHeight - 3 ? image.At(x, y + 3) : 0);
    }
  }
}

}  // namespace
}  // namespace rockyard::vision
