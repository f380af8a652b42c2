// Stages beside closed forms and hand-made cases: pyramid, rectification, range, parameters, codes.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/params_text.h"
#include "core/random.h"
#include "vision/each_pixel.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/dog.h"
#include "vision/stereo/pyramid.h"
#include "vision/stereo/rectification_table.h"
#include "vision/stereo/stereo.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {
namespace {

GrayImage RandomImage(int width, int height, std::uint32_t number) {
  core::RandomStream stream({26, 0}, core::Purpose::kTest, number);
  return ImageOf(width, height, [&](int, int) { return stream.NextU32(); });
}

TEST(PyramidTest, PixelsAreRoundedMeansOfSquares) {
  const GrayImage image = RandomImage(43, 38, 1);
  for (int level = 0; level <= 4; ++level) {
    const int side = 1 << level;
    const GrayImage reduced = ReduceImage(image, level);
    ASSERT_EQ(reduced.width(), 43 / side);
    ASSERT_EQ(reduced.height(), 38 / side);
    ForEachPixel(reduced.width(), reduced.height(), [&](int x, int y) {
      double sum = 0.0;
      for (int k = 0; k < side * side; ++k) {
        sum += image.At(x * side + k % side, y * side + k / side);
      }
      ASSERT_EQ(reduced.At(x, y), std::floor(sum / (side * side) + 0.5)) << level;
    });
  }
  EXPECT_EQ(ReduceImage(GrayImage(70, 70, 255), 6), GrayImage(1, 1, 255));
  EXPECT_TRUE(ReduceImage(RandomImage(3, 9, 2), 2).empty());
}

Image<SourcePosition> Positions(int width, int height, auto position) {
  return ImageOf<SourcePosition>(width, height, position);
}

TEST(RectificationTest, APlaneOfGreyIsSampledExactly) {
  const GrayImage plane = ImageOf(40, 30, [](int x, int y) { return 3 * x + 4 * y + 5; });
  const auto source = [](int x, int y) {
    return SourcePosition{0.9 * x + 0.05 * y + 0.123, 0.8 * y - 0.03 * x + 3.7};
  };
  const RectificationTable table(Positions(38, 30, source), 40, 30);
  const GrayImage out = table.Rectify(plane);
  ForEachPixel(38, 30, [&](int x, int y) {
    const SourcePosition from = source(x, y);
    // Half a grey level of rounding, and 1/512 px of position in x and y.
    ASSERT_NEAR(out.At(x, y), 3 * from.x_px + 4 * from.y_px + 5, 0.5 + 7.0 / 512.0);
  });
}

TEST(RectificationTest, FourPixelsWeighAsTheirAreas) {
  const GrayImage source =
      ImageOf(2, 2, [](int x, int y) { return y == 0 ? 10 + 240 * x : 100 - 100 * x; });
  for (const double fx : {0.0, 0.25, 0.5, 1.0}) {
    for (const double fy : {0.0, 0.125, 0.75, 1.0}) {
      const RectificationTable table(Image<SourcePosition>(1, 1, {fx, fy}), 2, 2);
      const double mean = (1 - fy) * ((1 - fx) * 10 + fx * 250) + fy * (1 - fx) * 100;
      EXPECT_EQ(table.Rectify(source).At(0, 0), std::floor(mean + 0.5)) << fx << " " << fy;
    }
  }
}

TEST(RectificationTest, TheIdentityGivesTheImageToItsLastPixel) {
  const GrayImage image = RandomImage(17, 11, 3);
  const auto source = [](int x, int y) { return SourcePosition{double(x), double(y)}; };
  const RectificationTable table(Positions(17, 11, source), 17, 11);
  EXPECT_EQ(table.Rectify(image), image);
  EXPECT_EQ(table.Inside(), Image<std::uint8_t>(17, 11, 1));
}

TEST(RectificationTest, WhatTheSourceDoesNotReachIsOutside) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const GrayImage white(9, 7, 200);
  const std::vector<SourcePosition> beyond{{-0.01, 3},    {8.01, 3},      {3, -0.01},
                                           {3, 6.01},     {nan, 3},       {3, nan},
                                           {infinity, 3}, {3, -infinity}, {1e300, 3}};
  for (const SourcePosition& position : beyond) {
    const RectificationTable table(Image<SourcePosition>(1, 1, position), 9, 7);
    EXPECT_EQ(table.Inside().At(0, 0), 0) << position.x_px << " " << position.y_px;
    EXPECT_EQ(table.Rectify(white).At(0, 0), 0);
  }
  const RectificationTable corner(Image<SourcePosition>(1, 1, {8.0, 6.0}), 9, 7);
  EXPECT_EQ(corner.Inside().At(0, 0), 1);
  EXPECT_EQ(corner.Rectify(white).At(0, 0), 200);
}

TEST(DifferenceOfGaussiansTest, ASpotIsABrightSquareInADarkOne) {
  GrayImage image(31, 31, 60);
  image.At(15, 15) = 195;
  const GrayImage out = DifferenceOfGaussians(image, {DogKind::kLaplacian, 3, 9, 2.0, 100});
  // 2 (135 / 9 - 135 / 81) = 26.67 in the narrow square, 2 (0 - 135 / 81) = -3.33 around it.
  EXPECT_EQ(out.At(15, 15), 127);
  EXPECT_EQ(out.At(14, 16), 127);
  EXPECT_EQ(out.At(17, 15), 97);
  EXPECT_EQ(out.At(19, 11), 97);
  EXPECT_EQ(out.At(20, 15), 100);
  EXPECT_EQ(DifferenceOfGaussians(image, {DogKind::kLaplacian, 3, 9, 2.0, 20}).At(15, 15), 40);
}

// A spot of 120 shows a quarter of it above, half of it beside, on either side with its sign; what
// only changes from row to row shows nothing.
TEST(DifferenceOfGaussiansTest, ARowGradientSeesWhatChangesAlongTheRow) {
  GrayImage image = ImageOf(9, 7, [](int, int y) { return 10 * y + 20; });
  const DogParams params{.kind = DogKind::kRowGradient, .gain = 0.5, .limit = 40};
  EXPECT_EQ(DifferenceOfGaussians(image, params), GrayImage(9, 7, 40));
  image.At(4, 3) = 170;
  const GrayImage out = DifferenceOfGaussians(image, params);
  EXPECT_EQ(out.At(3, 3), 40 + 30);  // 0.5 (2 * 120 / 4): what is to the right counts upwards
  EXPECT_EQ(out.At(5, 3), 40 - 30);
  EXPECT_EQ(out.At(3, 2), 40 + 15);
  EXPECT_EQ(out.At(5, 4), 40 - 15);
  EXPECT_EQ(out.At(4, 3), 40);
  EXPECT_EQ(out.At(3, 5), 40);
  EXPECT_EQ(out.At(2, 3), 40);
  image.At(4, 3) = 255;
  EXPECT_EQ(DifferenceOfGaussians(image, {.kind = DogKind::kRowGradient, .gain = 4.0, .limit = 9})
                .At(3, 3),
            18);
}

TEST(DepthRangeTest, DisparitiesAreThoseOfTheDepths) {
  // MER's Hazcam is of this class: 256 px of 120 deg and 10 cm, 0.3 to 3 m (Goldberg 2002 section
  // 2).
  const StereoGeometry pair{.focal_px = 74.0, .baseline_m = 0.1, .offset_px = 0.0};
  const CorrelatorParams range = SearchDepths(pair, 0.3, 3.0, {});
  // 74 * 0.1 / 3 = 2.47 and 7.4 / 0.3 = 24.67, outwards, and one more.
  EXPECT_EQ(range.min_disparity_px, 1);
  EXPECT_EQ(range.disparities, 26 - 1 + 1);
  const CorrelatorParams far = SearchDepths(pair, 1.0, std::numeric_limits<double>::infinity(), {});
  EXPECT_EQ(far.min_disparity_px, -1);
  EXPECT_EQ(far.disparities, 9 - -1 + 1);
  const CorrelatorParams moved = SearchDepths({74.0, 0.1, -30.5}, 1.0, 1.0, {});
  EXPECT_EQ(moved.min_disparity_px, -25);  // 7.4 - 30.5 = -23.1
  EXPECT_EQ(moved.disparities, 4);
}

TEST(DepthRangeTest, TooManyDisparitiesAreRefused) {
  EXPECT_NO_THROW(SearchDepths({1000.0, 0.5, 0.0}, 1.0, 500.0, {}));
  EXPECT_THROW(SearchDepths({1000.0, 0.5, 0.0}, 0.9, 500.0, {}), core::UserError);
  EXPECT_THROW(SearchDepths({1000.0, 0.5, 0.0}, 1e-300, 500.0, {}), core::UserError);
  EXPECT_THROW(SearchDepths({1000.0, 0.5, 0.0}, 1.0, 1.01, {}), core::UserError);
}

// The parabola through (-1, below), (0, best), (1, above), by its closed form.
TEST(SubPixelTest, RoundsTheLowestPoint) {
  for (int best = 0; best < 40; ++best) {
    for (int below = best + 1; below < best + 60; ++below) {
      for (int above = best + 1; above < best + 60; ++above) {
        const double delta = 0.5 * (below - above) / (below - 2 * best + above);
        const int found = SubPixel(Interpolation::kQuadratic, below, best, above);
        ASSERT_EQ(found, std::floor(32.0 * delta + 0.5)) << below << " " << best << " " << above;
        const double lines = 0.5 * (below - above) / (std::max(below, above) - best);
        const int crossed = SubPixel(Interpolation::kEquiangular, below, best, above);
        ASSERT_EQ(crossed, std::floor(32.0 * lines + 0.5)) << below << " " << best << " " << above;
        ASSERT_LE(std::abs(crossed), 16);
      }
    }
  }
}

TEST(DisparityTest, CodesOfDroppedPixelsAreNoDisparities) {
  for (int drop = 1; drop < kDropCount; ++drop) {
    const std::int16_t value = Dropped(static_cast<Drop>(drop));
    EXPECT_FALSE(IsValid(value));
    EXPECT_EQ(static_cast<int>(DropOf(value)), drop);
  }
  EXPECT_TRUE(IsValid(-31999));
  EXPECT_EQ(DropOf(0), Drop::kNone);
  EXPECT_DOUBLE_EQ(DisparityPx(-48), -1.5);
  DisparityImage image(3, 1, 64);
  image.At(1, 0) = Dropped(Drop::kBlob);
  image.At(2, 0) = Dropped(Drop::kOutside);
  EXPECT_EQ(CountDrops(image), (DropCounts{1, 1, 0, 0, 0, 0, 1}));
}

TEST(StereoTest, ImagesOfDifferentSizesAreRefused) {
  EXPECT_THAT(core::RefusalOf([] { MatchStereo(GrayImage(30, 20), GrayImage(30, 21), {}); }),
              testing::HasSubstr("30 x 21"));
}

void ExpectRefused(const std::string& json, const std::string& field) {
  EXPECT_THAT(core::ProblemsOf<StereoPipelineParams>(json), testing::HasSubstr(field)) << json;
}

TEST(StereoPipelineParamsTest, WhatCannotWorkIsRefused) {
  ExpectRefused(R"({"dog": {"narrow_side_px": 2}})", "narrow_side_px");
  ExpectRefused(R"({"dog": {"wide_side_px": 12}})", "wide_side_px");
  ExpectRefused(R"({"dog": {"narrow_side_px": 5, "wide_side_px": 5}})", "wide_side_px");
  ExpectRefused(R"({"dog": {"gain": 4.1}})", "gain");
  ExpectRefused(R"({"dog": {"kind": "sobel"}})", "kind");
  ExpectRefused(R"({"correlator": {"window_side_px": 16}, "dog": {"limit": 36}})",
                "window_side_px");
  ExpectRefused(R"({"correlator": {"window_side_px": 9}, "dog": {"limit": 127}})",
                "window_side_px");
  ExpectRefused(R"({"correlator": {"disparities": 0}})", "disparities");
  ExpectRefused(R"({"filters": {"min_curvature": -1}})", "min_curvature");
  ExpectRefused(R"({"filters": {"interpolation": "cubic"}})", "interpolation");
}

TEST(StereoPipelineParamsTest, ExtremesThatAreAcceptedFitTheirBits) {
  for (const char* json : {R"({"correlator": {"window_side_px": 15}})",
                           R"({"correlator": {"window_side_px": 8}, "dog": {"limit": 127}})",
                           R"({"correlator": {"window_side_px": 21}, "dog": {"limit": 18}})",
                           R"({"correlator": {"min_disparity_px": 480, "disparities": 512}})"}) {
    StereoPipelineParams params;
    ASSERT_NO_THROW(params = core::ReadText<StereoPipelineParams>(json)) << json;
    const auto side = params.correlator.window_side_px;
    // The largest key is no mask, and the largest disparity no code of a dropped pixel.
    EXPECT_LT(4 * side * side * 2 * params.dog.limit + 3, 0xFFFF) << json;
    EXPECT_LT(32 * (params.correlator.min_disparity_px + params.correlator.disparities), 32767);
  }
}

}  // namespace
}  // namespace rockyard::vision
