// Time from rectified images to filtered disparities, beside OpenCV's StereoBM on the same images
// where OpenCV is installed. Each run prints its instruction set and a hash of what comes out.
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#ifdef ROCKYARD_HAS_OPENCV
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#endif

#include "instruction_sets.h"
#include "synthetic_pair.h"
#include "vision/each_pixel.h"
#include "vision/stereo/blob.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/dog.h"
#include "vision/stereo/pyramid.h"
#include "vision/stereo/rectification_table.h"
#include "vision/stereo/stereo.h"

namespace rockyard::vision {
namespace {

struct Size {
  int width, height, disparities;
};

Size SizeOf(const benchmark::State& state) {
  return {static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
          static_cast<int>(state.range(2))};
}

const SyntheticPair& PairOf(const Size& size) {
  static std::map<std::tuple<int, int, int>, SyntheticPair> pairs;
  const auto key = std::tuple(size.width, size.height, size.disparities);
  const auto found = pairs.find(key);
  if (found != pairs.end()) return found->second;
  const Scene scene{.width = size.width,
                    .height = size.height,
                    .disparity = SteppedGround(size.width, size.height, size.disparities)};
  return pairs.emplace(key, MakePair(scene)).first->second;
}

StereoPipelineParams ParamsOf(const Size& size, int side) {
  return {.correlator = {.window_side_px = side, .disparities = size.disparities}};
}

void Sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"width", "height", "disparities"})
      ->Args({256, 240, 32})
      ->Args({512, 384, 64})
      ->Args({1024, 768, 128})
      ->Unit(benchmark::kMillisecond);
}

void Label(benchmark::State& state, const DisparityImage& image) {
  state.SetLabel(std::string(InstructionSet()) + ", hash " + HashOf(image));
  state.counters["density"] =
      static_cast<double>(CountDrops(image)[0]) / static_cast<double>(image.values().size());
}

void Pipeline(benchmark::State& state, std::int64_t set, int side) {
  if ((hwy::SupportedTargets() & set) == 0) {
    state.SkipWithError("this machine lacks the instruction set");
    return;
  }
  const UseInstructionSet use(set);
  const Size size = SizeOf(state);
  const SyntheticPair& pair = PairOf(size);
  const StereoPipelineParams params = ParamsOf(size, side);
  StereoProducts products;
  for ([[maybe_unused]] auto _ : state) {
    MatchStereo(pair.left, pair.right, params, 1, products);
    benchmark::ClobberMemory();
  }
  Label(state, products.disparities);
}

BENCHMARK_CAPTURE(Pipeline, sse4, HWY_SSE4, 7)->Apply(Sizes);
BENCHMARK_CAPTURE(Pipeline, avx2, HWY_AVX2, 7)->Apply(Sizes);
BENCHMARK_CAPTURE(Pipeline, avx512, HWY_AVX3, 7)->Apply(Sizes);
BENCHMARK_CAPTURE(Pipeline, avx2_13x13, HWY_AVX2, 13)->Apply(Sizes);
BENCHMARK_CAPTURE(Pipeline, avx512_13x13, HWY_AVX3, 13)->Apply(Sizes);

void Filter(benchmark::State& state) {
  const SyntheticPair& pair = PairOf(SizeOf(state));
  GrayImage out(pair.left.width(), pair.left.height());
  for ([[maybe_unused]] auto _ : state) {
    DifferenceOfGaussiansRows(pair.left, {}, 0, out.height(), out);
    DifferenceOfGaussiansRows(pair.right, {}, 0, out.height(), out);
  }
}
BENCHMARK(Filter)->Apply(Sizes);

void Correlate(benchmark::State& state) {
  const Size size = SizeOf(state);
  const SyntheticPair& pair = PairOf(size);
  const StereoPipelineParams params = ParamsOf(size, 7);
  const GrayImage left = DifferenceOfGaussians(pair.left, params.dog);
  const GrayImage right = DifferenceOfGaussians(pair.right, params.dog);
  DisparityImage out(size.width, size.height);
  for ([[maybe_unused]] auto _ : state) CorrelateRows(left, right, params, 0, size.height, out);
  Label(state, out);
}
BENCHMARK(Correlate)->Apply(Sizes);

void Blobs(benchmark::State& state) {
  const Size size = SizeOf(state);
  const SyntheticPair& pair = PairOf(size);
  const StereoPipelineParams params = ParamsOf(size, 7);
  DisparityImage matched(size.width, size.height);
  CorrelateRows(DifferenceOfGaussians(pair.left, params.dog),
                DifferenceOfGaussians(pair.right, params.dog), params, 0, size.height, matched);
  DisparityImage out = matched;
  for ([[maybe_unused]] auto _ : state) {
    std::copy(matched.values().begin(), matched.values().end(), out.values().begin());
    FilterBlobs(params.filters, out);
  }
  Label(state, out);
}
BENCHMARK(Blobs)->Apply(Sizes);

void Reduce(benchmark::State& state) {
  const SyntheticPair& pair = PairOf(SizeOf(state));
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(ReduceImage(pair.left, 2));
}
BENCHMARK(Reduce)->Apply(Sizes);

void Rectify(benchmark::State& state) {
  const Size size = SizeOf(state);
  const SyntheticPair& pair = PairOf(size);
  Image<SourcePosition> positions(size.width, size.height);
  ForEachPixel(size.width, size.height, [&](int x, int y) {
    positions.At(x, y) = {0.99 * x + 0.01 * y + 0.3, 0.98 * y - 0.005 * x + 5.0};
  });
  const RectificationTable table(positions, size.width, size.height);
  GrayImage out(size.width, size.height);
  for ([[maybe_unused]] auto _ : state) table.RectifyRows(pair.left, 0, size.height, out);
}
BENCHMARK(Rectify)->Apply(Sizes);

#ifdef ROCKYARD_HAS_OPENCV

cv::Mat MatOf(const GrayImage& image) {
  return cv::Mat(image.height(), image.width(), CV_8U,
                 const_cast<std::uint8_t*>(image.values().data()))
      .clone();
}

// The same stages: XSOBEL for the difference of Gaussians, both directions, speckle filter.
void OpenCv(benchmark::State& state, int speckle_window) {
  cv::setNumThreads(1);
  const Size size = SizeOf(state);
  const SyntheticPair& pair = PairOf(size);
  const cv::Mat left = MatOf(pair.left);
  const cv::Mat right = MatOf(pair.right);
  const cv::Ptr<cv::StereoBM> matcher = cv::StereoBM::create(size.disparities, 7);
  matcher->setPreFilterType(cv::StereoBM::PREFILTER_XSOBEL);
  matcher->setDisp12MaxDiff(1);
  matcher->setSpeckleWindowSize(speckle_window);
  matcher->setSpeckleRange(1);
  cv::Mat disparities;
  for ([[maybe_unused]] auto _ : state) matcher->compute(left, right, disparities);
  DisparityImage out(size.width, size.height);
  ForEachPixel(size.width, size.height, [&](int x, int y) {
    const auto value = disparities.at<std::int16_t>(y, x);
    out.At(x, y) = value < 0 ? Dropped(Drop::kOutside) : static_cast<std::int16_t>(2 * value);
  });
  Label(state, out);
  state.SetLabel("OpenCV " CV_VERSION ", hash " + HashOf(out));
}
BENCHMARK_CAPTURE(OpenCv, bm, 50)->Apply(Sizes);
BENCHMARK_CAPTURE(OpenCv, bm_no_speckle_filter, 0)->Apply(Sizes);

#endif  // ROCKYARD_HAS_OPENCV

}  // namespace
}  // namespace rockyard::vision
