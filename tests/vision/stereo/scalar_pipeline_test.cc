// The scalar stages that benchmarks compare with give the bits of the plain ones, whichever way
// they are compiled: what is compared there does the same.
#include "scalar_pipeline.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>

#include "core/random.h"
#include "plain_stereo.h"
#include "vision/each_pixel.h"
#include "vision/stereo/pyramid.h"

namespace rockyard::vision {
namespace {

GrayImage RandomImage(int width, int height, std::uint32_t levels, std::uint32_t number) {
  core::RandomStream stream({25, 0}, core::Purpose::kTest, number);
  return ImageOf(width, height, [&](int, int) { return stream.NextU32() % levels; });
}

// Every other pixel is the left one's at this disparity.
GrayImage Seen(const GrayImage& left, int disparity, std::uint32_t levels) {
  GrayImage right = RandomImage(left.width(), left.height(), levels, 99);
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
        const GrayImage left = RandomImage(61, 19, levels, 1);
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
  const GrayImage image = RandomImage(53, 31, 256, 2);
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
  const GrayImage left = RandomImage(40, 20, 63, 3);
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
