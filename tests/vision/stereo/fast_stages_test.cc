#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "core/random.h"
#include "instruction_sets.h"
#include "plain_stereo.h"
#include "scalar_pipeline.h"
#include "vision/each_pixel.h"
#include "vision/stereo/blob.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/dog.h"
#include "vision/stereo/pyramid.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

// The fast stages give the bits of the plain ones: all instruction sets, odd sizes, windows,
// ranges.

GrayImage RandomImage(int width, int height, int levels, std::uint32_t number) {
  core::RandomStream stream({23, 0}, core::Purpose::kTest, number);
  return ImageOf(width, height,
                 [&](int, int) { return stream.NextU32() % static_cast<std::uint32_t>(levels); });
}

// The left image moved by `shift` pixels, with some pixels of its own.
GrayImage Moved(const GrayImage& left, int shift, int levels, std::uint32_t number) {
  GrayImage right = RandomImage(left.width(), left.height(), levels, number);
  core::RandomStream stream({24, 0}, core::Purpose::kTest, number);
  ForEachPixel(left.width(), left.height(), [&](int x, int y) {
    const int from = x + shift + (y > left.height() / 2 ? 1 : 0);
    if (from >= 0 && from < left.width() && stream.Uniform() < 0.9) {
      right.At(x, y) = left.At(from, y);
    }
  });
  return right;
}

struct Case {
  int width, height, side, min_disparity, disparities;
};

StereoPipelineParams ParamsOf(const Case& c) {
  StereoPipelineParams params;
  params.dog.limit = 31;
  params.correlator = {
      .window_side_px = c.side, .min_disparity_px = c.min_disparity, .disparities = c.disparities};
  params.filters.min_curvature = 0.3;
  params.filters.min_curvature_ratio = 0.11;
  params.filters.blob_min_px = 6;
  return params;
}

std::string Describe(const Case& c) {
  return std::to_string(c.width) + " x " + std::to_string(c.height) + ", window " +
         std::to_string(c.side) + ", from " + std::to_string(c.min_disparity) + ", " +
         std::to_string(c.disparities) + " disparities";
}

// Images of many levels, and of two where nearly all scores are equal to others.
void ExpectSameMatches(const Case& c, std::uint32_t number) {
  StereoPipelineParams params = ParamsOf(c);
  for (const int levels : {63, 2}) {
    params.filters.interpolation =
        levels == 63 ? Interpolation::kQuadratic : Interpolation::kEquiangular;
    const GrayImage left = RandomImage(c.width, c.height, levels, number);
    const int shift = c.min_disparity + c.disparities / 2;
    const GrayImage right = Moved(left, shift, levels, number + 1);
    const DisparityImage expected = PlainCorrelate(left, right, params);
    for (const std::int64_t set : InstructionSets()) {
      const UseInstructionSet use(set);
      DisparityImage found(c.width, c.height, 77);
      CorrelateRows(left, right, params, 0, c.height, found);
      ASSERT_EQ(found, expected) << Describe(c) << ", " << levels << " levels, "
                                 << InstructionSet();
    }
  }
}

TEST(FastStagesTest, InstructionSetsAreTheOnesAskedFor) {
  const auto sets = InstructionSets();
  ASSERT_GE(sets.size(), 2U);
  for (const std::int64_t set : sets) {
    const UseInstructionSet use(set);
    EXPECT_STREQ(InstructionSet(), hwy::TargetName(set));
  }
}

TEST(FastStagesTest, MatchesOfEveryWindowSide) {
  for (int side = 1; side <= 15; ++side) ExpectSameMatches({97, side + 6, side, -3, 22}, side);
}

TEST(FastStagesTest, MatchesOfEveryWidth) {
  for (int width = 1; width <= 70; ++width) ExpectSameMatches({width, 9, 5, 0, 9}, 100 + width);
}

TEST(FastStagesTest, MatchesOfEveryRange) {
  for (const int min_disparity : {-130, -40, -17, -5, -1, 0, 1, 6, 33, 64, 129}) {
    for (const int disparities : {1, 2, 3, 4, 5, 8, 31, 64}) {
      ExpectSameMatches({75, 8, 4, min_disparity, disparities}, 300);
    }
  }
}

TEST(FastStagesTest, MatchesOfImagesOfAPixelOrARow) {
  for (const Case& c : {Case{1, 1, 1, 0, 1}, Case{1, 1, 7, -2, 5}, Case{1, 20, 3, 0, 4},
                        Case{200, 1, 1, -9, 20}, Case{3, 3, 3, -1, 3}, Case{2, 40, 2, -2, 5},
                        Case{7, 7, 7, -4, 9}, Case{8, 8, 8, -4, 9}, Case{6, 6, 7, 0, 4}}) {
    ExpectSameMatches(c, 500);
  }
}

// Where the lanes hold the row without a gap and windows end at the pixel, the last lane's last
// pixel and the first lane's first one are candidates beside what is out of the image.
TEST(FastStagesTest, MatchesAtTheEndsOfRowsThatFillTheLanes) {
  for (const int width : {32, 64, 128, 256}) {
    for (const int min_disparity : {-9, -4, 0, 3}) {
      for (const int side : {1, 2}) ExpectSameMatches({width, 12, side, min_disparity, 9}, 550);
    }
  }
}

TEST(FastStagesTest, MatchesOfAnOrdinaryPair) {
  ExpectSameMatches({256, 24, 7, 0, 32}, 600);
  ExpectSameMatches({259, 20, 8, -16, 61}, 602);
}

// 127 levels to either side leave the largest sums just inside their 16 bits.
TEST(FastStagesTest, LargestScoresFit) {
  StereoPipelineParams params = ParamsOf({120, 14, 8, -2, 9});
  params.dog.limit = 127;
  const GrayImage left =
      ImageOf(120, 14, [](int x, int y) { return x < 60 || x % 7 == y % 5 ? 254 : 0; });
  const GrayImage right(120, 14);
  const DisparityImage expected = PlainCorrelate(left, right, params);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    DisparityImage found(120, 14);
    CorrelateRows(left, right, params, 0, 14, found);
    ASSERT_EQ(found, expected) << InstructionSet();
  }
}

TEST(FastStagesTest, BandsOfRowsGiveTheWhole) {
  const Case c{83, 31, 7, -2, 18};
  const GrayImage left = RandomImage(c.width, c.height, 40, 700);
  const GrayImage right = Moved(left, 5, 40, 701);
  const DisparityImage expected = PlainCorrelate(left, right, ParamsOf(c));
  for (const int band : {1, 2, 5, 13, 30}) {
    DisparityImage found(c.width, c.height);
    for (int y = 0; y < c.height; y += band) {
      CorrelateRows(left, right, ParamsOf(c), y, std::min(y + band, c.height), found);
    }
    ASSERT_EQ(found, expected) << band;
  }
}

void ExpectSameFilter(const GrayImage& image, const DogParams& params) {
  const GrayImage expected = PlainDifferenceOfGaussians(image, params);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    ASSERT_EQ(DifferenceOfGaussians(image, params), expected)
        << image.width() << " x " << image.height() << ", " << params.narrow_side_px << ", "
        << params.wide_side_px << ", " << InstructionSet();
  }
}

TEST(FastStagesTest, DifferenceOfGaussiansOfEverySide) {
  for (const int narrow : {1, 3, 5}) {
    for (const int wide : {3, 5, 7, 9, 11, 13, 15}) {
      if (wide <= narrow) continue;
      for (const double gain : {0.125, 1.0, 2.3, 4.0}) {
        const DogParams params{DogKind::kLaplacian, narrow, wide, gain, gain > 2.0 ? 127 : 25};
        ExpectSameFilter(RandomImage(75, 19, 256, 800), params);
        ExpectSameFilter(RandomImage(75, 19, 2, 801), params);
      }
    }
  }
}

TEST(FastStagesTest, RowGradientOfEveryGain) {
  for (const double gain : {0.125, 0.3, 1.0, 2.3, 4.0}) {
    for (const int limit : {1, 15, 127}) {
      const DogParams params{DogKind::kRowGradient, 1, 11, gain, limit};
      ExpectSameFilter(RandomImage(75, 19, 256, 802), params);
      ExpectSameFilter(RandomImage(75, 19, 9, 803), params);
    }
  }
}

TEST(FastStagesTest, DifferenceOfGaussiansOfEverySize) {
  for (const DogKind kind : {DogKind::kLaplacian, DogKind::kRowGradient}) {
    const DogParams params{.kind = kind, .gain = 1.0, .limit = 100};
    for (int width = 1; width <= 68; ++width) {
      ExpectSameFilter(RandomImage(width, 5, 256, 820), params);
    }
    for (int height = 1; height <= 20; ++height) {
      ExpectSameFilter(RandomImage(33, height, 256, 821), params);
    }
  }
}

TEST(FastStagesTest, DifferenceOfGaussiansOfExtremes) {
  const GrayImage steps =
      ImageOf(70, 30, [](int x, int y) { return (x / 9 + y / 7) % 2 == 0 ? 255 : 0; });
  ExpectSameFilter(steps, {DogKind::kLaplacian, 1, 15, 4.0, 127});
  ExpectSameFilter(steps, {DogKind::kRowGradient, 1, 11, 4.0, 127});
  ExpectSameFilter(GrayImage(70, 30, 255), {DogKind::kLaplacian, 3, 15, 4.0, 127});
}

DisparityImage RandomDisparities(int width, int height, int spread, double valid,
                                 std::uint32_t number) {
  core::RandomStream stream({25, 0}, core::Purpose::kTest, number);
  return ImageOf<std::int16_t>(width, height, [&](int, int) {
    const auto one = static_cast<int>(stream.NextU32() % static_cast<std::uint32_t>(spread));
    return stream.Uniform() < valid ? one - spread / 2 : Dropped(Drop::kLineOfSight);
  });
}

void ExpectSameBlobs(const DisparityImage& image, const StereoFilterParams& filters) {
  DisparityImage expected = image;
  PlainFilterBlobs(filters, expected);
  for (const std::int64_t set : InstructionSets()) {
    const UseInstructionSet use(set);
    DisparityImage found = image;
    FilterBlobs(filters, found);
    ASSERT_EQ(found, expected) << image.width() << " x " << image.height() << ", "
                               << filters.blob_min_px << ", " << InstructionSet();
  }
}

TEST(FastStagesTest, BlobsOfEverySize) {
  StereoFilterParams filters;
  for (const std::int64_t min_px : {0, 1, 2, 5, 40, 1000}) {
    for (const double step : {0.0, 0.5, 1.0}) {
      filters.blob_min_px = min_px;
      filters.blob_max_step_px = step;
      for (const double valid : {0.4, 0.6, 0.95}) {
        ExpectSameBlobs(RandomDisparities(131, 40, 60, valid, 900), filters);
      }
    }
  }
}

TEST(FastStagesTest, BlobsOfEveryWidth) {
  const StereoFilterParams filters{.blob_min_px = 7, .blob_max_step_px = 0.75};
  for (int width = 1; width <= 140; ++width) {
    ExpectSameBlobs(RandomDisparities(width, 7, 50, 0.7, 1000 + width), filters);
  }
}

TEST(FastStagesTest, BlobsOfTheLargestDisparities) {
  const StereoFilterParams filters{.blob_min_px = 3, .blob_max_step_px = 100.0};
  ExpectSameBlobs(RandomDisparities(90, 12, 63999, 0.9, 1200), filters);
}

TEST(FastStagesTest, ThePipelineIsItsStages) {
  const Case c{150, 60, 7, 0, 20};
  const StereoPipelineParams params = ParamsOf(c);
  const GrayImage left = RandomImage(c.width, c.height, 256, 1300);
  const GrayImage right = Moved(left, 6, 256, 1301);
  DisparityImage expected = PlainCorrelate(PlainDifferenceOfGaussians(left, params.dog),
                                           PlainDifferenceOfGaussians(right, params.dog), params);
  PlainFilterBlobs(params.filters, expected);
  EXPECT_EQ(MatchStereo(left, right, params), expected);
  StereoProducts products;
  for (const int threads : {1, 2, 3, 7, 61}) {
    MatchStereo(left, right, params, threads, products);
    EXPECT_EQ(products.disparities, expected) << threads;
    EXPECT_EQ(products.left_filtered, PlainDifferenceOfGaussians(left, params.dog)) << threads;
  }
}

// The scalar stages that benchmarks compare with give the bits of the plain ones, whichever way
// they are compiled: what is compared there does the same.

GrayImage NoiseImage(int width, int height, std::uint32_t levels, std::uint32_t number) {
  core::RandomStream stream({25, 0}, core::Purpose::kTest, number);
  return ImageOf(width, height, [&](int, int) { return stream.NextU32() % levels; });
}

// Every other pixel is the left one's at this disparity.
GrayImage Seen(const GrayImage& left, int disparity, std::uint32_t levels) {
  GrayImage right = NoiseImage(left.width(), left.height(), levels, 99);
  ForEachPixel(left.width(), left.height(), [&](int x, int y) {
    const int from = x + disparity;
    if (from >= 0 && from < left.width() && (x + y) % 5 != 0) right.At(x, y) = left.At(from, y);
  });
  return right;
}

StereoPipelineParams ParamsOf(int side, int min_disparity, int disparities) {
  StereoPipelineParams params = AsPrinted();
  params.correlator = {
      .window_side_px = side, .min_disparity_px = min_disparity, .disparities = disparities};
  params.filters.min_curvature = 0.3;
  params.filters.min_curvature_ratio = 0.1;
  return params;
}

class ScalarPipelineTest : public testing::TestWithParam<const ScalarStages* (*)()> {
 protected:
  static const ScalarStages& stages() { return *GetParam()(); }
};

TEST_P(ScalarPipelineTest, MatchesAsThePlainCorrelator) {
  for (const int side : {2, 7, 8}) {
    for (const int min_disparity : {-9, 0, 5}) {
      for (const std::uint32_t levels : {2U, 63U}) {
        StereoPipelineParams params = ParamsOf(side, min_disparity, 13);
        // Where there are few scores, some meet the limit c = 6 S itself.
        if (levels == 2) params.filters.min_curvature_ratio = 6.0;
        if (side == 8) params.filters.interpolation = Interpolation::kEquiangular;
        const GrayImage left = NoiseImage(61, 19, levels, 1);
        const GrayImage right = Seen(left, min_disparity + 6, levels);
        DisparityImage found(61, 19, 77);
        ScalarPipeline(stages(), 61, params).Correlate(left, right, RowStage::kDecide, found);
        const DisparityImage expected = PlainCorrelate(left, right, params);
        ASSERT_EQ(found, expected) << side << " " << min_disparity << " " << levels;
        EXPECT_GT(CountDrops(found)[0], levels == 2 ? 0 : 100);
      }
    }
  }
}

TEST_P(ScalarPipelineTest, FiltersAndReducesAsThePlainStages) {
  const GrayImage image = NoiseImage(53, 31, 256, 2);
  StereoPipelineParams params = AsPrinted();
  for (const auto& [narrow, wide] : {std::pair{1, 11}, {3, 9}, {5, 21}}) {
    params.dog = {.kind = DogKind::kLaplacian,
                  .narrow_side_px = narrow,
                  .wide_side_px = wide,
                  .gain = 1.5,
                  .limit = 40};
    GrayImage found(53, 31);
    ScalarPipeline pipeline(stages(), 53, params);
    pipeline.Filter(image, found);
    EXPECT_EQ(found, PlainDifferenceOfGaussians(image, params.dog)) << narrow << " " << wide;
    for (const int level : {1, 2}) {
      EXPECT_EQ(pipeline.Reduce(image, level), ReduceImage(image, level));
    }
  }
}

TEST_P(ScalarPipelineTest, WritesNothingBeforeItDecides) {
  const GrayImage left = NoiseImage(40, 20, 63, 3);
  DisparityImage out(40, 20, 77);
  const DisparityImage nothing(40, 20, Dropped(Drop::kOutside));
  for (const RowStage last : {RowStage::kPrepare, RowStage::kCompare}) {
    ScalarPipeline(stages(), 40, ParamsOf(7, 0, 8)).Correlate(left, left, last, out);
    EXPECT_EQ(out, nothing);
  }
}

INSTANTIATE_TEST_SUITE_P(BothWays, ScalarPipelineTest,
                         testing::Values(
                             +[] { return &UnoptimizedStages(); },
                             +[] { return &OptimizedStages(); }),
                         [](const auto& way) {
                           return way.index == 0 ? "Unoptimized" : "Optimized";
                         });

}  // namespace
}  // namespace rockyard::vision
