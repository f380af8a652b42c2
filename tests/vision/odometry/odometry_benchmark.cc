// Time to detect features in two images of 512 x 384 pixels and to match 400 of one with 400 of the
// other, beside OpenCV's goodFeaturesToTrack and brute-force matcher where OpenCV is installed.
// Each run prints its instruction set and a hash of what comes out.
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

#ifdef ROCKYARD_HAS_OPENCV
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#endif

#include "core/hash.h"
#include "textured_image.h"
#include "vision/odometry/detect_features.h"
#include "vision/odometry/match_features.h"
#include "vision/odometry/window.h"
#include "vision/stereo/correlator.h"
#include "vision/stereo/instruction_sets.h"

namespace rockyard::vision {
namespace {

constexpr int kWidth = 512;
constexpr int kHeight = 384;

// What a camera sees before and after it moved by some pixels.
struct ImagePair {
  GrayImage first;
  GrayImage second;
};

ImagePair MakePair(std::uint32_t number) {
  const WaveTexture texture(number, 4.0, 40.0);
  return {texture.Render(kWidth, kHeight, 0.0, 0.0, 25.0, 1.5, 0),
          texture.Render(kWidth, kHeight, 3.3 + number % 5, -2.6, 25.0, 1.5, 1)};
}

const ImagePair& Pair() {
  static const ImagePair pair = MakePair(0);
  return pair;
}

FeatureDetectorParams DetectorOf(Adapted adapted) { return {.adapted = adapted}; }

// Every feature with every one.
FeatureMatcherParams MatcherOfAll() {
  return {.search = MatchSearch::kAll, .warp = MatchWarp::kNone};
}

std::string HashOf(const Features& first, const Features& second, const FeatureMatches& matches) {
  core::Hasher hash;
  for (const Features* const features : {&first, &second}) {
    for (const Feature& feature : *features) {
      hash.Integer(static_cast<std::uint64_t>(feature.column));
      hash.Integer(static_cast<std::uint64_t>(feature.row));
      hash.Integer(static_cast<std::uint64_t>(feature.strength));
    }
  }
  for (const FeatureMatch& match : matches) {
    hash.Integer(static_cast<std::uint64_t>(match.first));
    hash.Integer(static_cast<std::uint64_t>(match.second));
    hash.Integer(static_cast<std::uint64_t>(match.difference));
  }
  return core::Hex(hash.value());
}

void Count(benchmark::State& state, const Features& first, const Features& second,
           const FeatureMatches& matches) {
  state.counters["features"] = static_cast<double>(first.size());
  state.counters["matches"] = static_cast<double>(matches.size());
  state.SetLabel(std::string(InstructionSet()) + ", hash " + HashOf(first, second, matches));
}

bool Lacks(benchmark::State& state, std::int64_t set) {
  if ((hwy::SupportedTargets() & set) != 0) return false;
  state.SkipWithError("this machine lacks the instruction set");
  return true;
}

// The two images of a pair and all matches between them.
void DetectAndMatch(benchmark::State& state, std::int64_t set, Adapted adapted) {
  if (Lacks(state, set)) return;
  const UseInstructionSet use(set);
  const FeatureDetector detector(DetectorOf(adapted), {kWidth, kHeight});
  const ImagePair& pair = Pair();
  Features first;
  Features second;
  FeatureMatches matches;
  for ([[maybe_unused]] auto _ : state) {
    first = detector.Detect(pair.first);
    second = detector.Detect(pair.second);
    matches = MatchFeatures(pair.first, first, pair.second, second, MatcherOfAll());
    benchmark::ClobberMemory();
  }
  Count(state, first, second, matches);
}

BENCHMARK_CAPTURE(DetectAndMatch, avx512, HWY_AVX3, Adapted::kThreshold)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(DetectAndMatch, avx2, HWY_AVX2, Adapted::kThreshold)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(DetectAndMatch, sse4, HWY_SSE4, Adapted::kThreshold)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(DetectAndMatch, avx512_weight, HWY_AVX3, Adapted::kWeight)
    ->Unit(benchmark::kMillisecond);

void Detect(benchmark::State& state, Adapted adapted) {
  const FeatureDetector detector(DetectorOf(adapted), {kWidth, kHeight});
  const GrayImage& image = Pair().first;
  Features features;
  for ([[maybe_unused]] auto _ : state) {
    features = detector.Detect(image);
    benchmark::ClobberMemory();
  }
  Count(state, features, {}, {});
}
BENCHMARK_CAPTURE(Detect, threshold, Adapted::kThreshold)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Detect, weight, Adapted::kWeight)->Unit(benchmark::kMillisecond);

// Where a motion is predicted, with and without windows that turn by it.
void Match(benchmark::State& state, MatchSearch search, MatchWarp warp) {
  const FeatureDetector detector(DetectorOf(Adapted::kThreshold), {kWidth, kHeight});
  const Features first = detector.Detect(Pair().first);
  const Features second = detector.Detect(Pair().second);
  const FeatureMatcherParams params{.search = search, .warp = warp};
  PredictedFeatures predicted;
  for (const Feature& feature : first) {
    PredictedFeature place{{feature.column - 3.3, feature.row + 2.6}, {}};
    place.view.by_offset(0, 1) = 0.02;
    predicted.push_back(place);
  }
  FeatureMatches matches;
  for ([[maybe_unused]] auto _ : state) {
    matches = MatchFeatures(Pair().first, first, Pair().second, second, params, predicted);
    benchmark::ClobberMemory();
  }
  Count(state, first, second, matches);
}
BENCHMARK_CAPTURE(Match, all, MatchSearch::kAll, MatchWarp::kNone)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Match, predicted, MatchSearch::kPredicted, MatchWarp::kNone)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Match, all_warped, MatchSearch::kAll, MatchWarp::kPredicted)
    ->Unit(benchmark::kMillisecond);

// Milliseconds that this thread has computed.
double ThreadTime_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

// Howard 2012 section 3: one hundred pairs of images. Counters are milliseconds of a pair, of the
// thread's own time: to detect in both, to match, and both.
void HundredPairs(benchmark::State& state) {
  constexpr std::uint32_t kPairs = 100;
  std::vector<ImagePair> pairs;
  for (std::uint32_t number = 0; number < kPairs; ++number) pairs.push_back(MakePair(number));
  const FeatureDetector detector(DetectorOf(Adapted::kThreshold), {kWidth, kHeight});
  std::vector<double> detect_ms, match_ms, all_ms;
  double features = 0.0, matched = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    for (const ImagePair& pair : pairs) {
      const double start = ThreadTime_ms();
      const Features first = detector.Detect(pair.first);
      const Features second = detector.Detect(pair.second);
      const double detected = ThreadTime_ms();
      const FeatureMatches matches =
          MatchFeatures(pair.first, first, pair.second, second, MatcherOfAll());
      const double end = ThreadTime_ms();
      detect_ms.push_back(detected - start);
      match_ms.push_back(end - detected);
      all_ms.push_back(end - start);
      features += static_cast<double>(first.size());
      matched += static_cast<double>(matches.size());
    }
  }
  const auto report = [&](const std::string& name, std::vector<double>& times) {
    std::sort(times.begin(), times.end());
    state.counters[name + "_min_ms"] = times.front();
    state.counters[name + "_median_ms"] = times[times.size() / 2];
    state.counters[name + "_max_ms"] = times.back();
  };
  const auto count = static_cast<double>(all_ms.size());
  state.counters["features"] = features / count;
  state.counters["matches"] = matched / count;
  report("detect", detect_ms);
  report("match", match_ms);
  report("all", all_ms);
  state.SetLabel(InstructionSet());
}
BENCHMARK(HundredPairs)->Unit(benchmark::kMillisecond);

#ifdef ROCKYARD_HAS_OPENCV

cv::Mat MatOf(const GrayImage& image) {
  return cv::Mat(image.height(), image.width(), CV_8U,
                 const_cast<std::uint8_t*>(image.values().data()))
      .clone();
}

// Corners that keep half a window from the edges.
std::vector<cv::Point2f> OpenCvCorners(const cv::Mat& image) {
  constexpr int kBorder = 8;
  cv::Mat mask(image.size(), CV_8U, cv::Scalar(0));
  mask(cv::Rect(kBorder, kBorder, image.cols - 2 * kBorder, image.rows - 2 * kBorder)) = 255;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(image, corners, 400, 1e-4, 3.0, mask, 5, true, 0.04);
  return corners;
}

// Windows of 15 x 15 pixels, one a row.
cv::Mat OpenCvWindows(const cv::Mat& image, const std::vector<cv::Point2f>& corners) {
  cv::Mat windows(static_cast<int>(corners.size()), 225, CV_8U);
  for (int i = 0; i < windows.rows; ++i) {
    const cv::Point2f& corner = corners[static_cast<std::size_t>(i)];
    const cv::Rect place(static_cast<int>(corner.x) - 7, static_cast<int>(corner.y) - 7, 15, 15);
    image(place).clone().reshape(1, 1).copyTo(windows.row(i));
  }
  return windows;
}

std::vector<cv::DMatch> OpenCvMatches(const cv::Mat& first, const cv::Mat& second) {
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_L1, true).match(first, second, matches);
  return matches;
}

void OpenCvDetectAndMatch(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat first = MatOf(Pair().first);
  const cv::Mat second = MatOf(Pair().second);
  std::size_t features = 0, matches = 0;
  for ([[maybe_unused]] auto _ : state) {
    const auto first_corners = OpenCvCorners(first);
    const auto second_corners = OpenCvCorners(second);
    features = first_corners.size();
    matches =
        OpenCvMatches(OpenCvWindows(first, first_corners), OpenCvWindows(second, second_corners))
            .size();
  }
  state.counters["features"] = static_cast<double>(features);
  state.counters["matches"] = static_cast<double>(matches);
  state.SetLabel("OpenCV " CV_VERSION);
}
BENCHMARK(OpenCvDetectAndMatch)->Unit(benchmark::kMillisecond);

void OpenCvDetect(benchmark::State& state) {
  cv::setNumThreads(1);
  const cv::Mat image = MatOf(Pair().first);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(OpenCvCorners(image));
  state.SetLabel("OpenCV " CV_VERSION);
}
BENCHMARK(OpenCvDetect)->Unit(benchmark::kMillisecond);

// The features of rockyard, so that both match the same.
void OpenCvMatch(benchmark::State& state) {
  cv::setNumThreads(1);
  const FeatureDetector detector(DetectorOf(Adapted::kThreshold), {kWidth, kHeight});
  const auto windows_of = [&](const GrayImage& image) {
    std::vector<cv::Point2f> corners;
    for (const Feature& feature : detector.Detect(image)) {
      corners.emplace_back(feature.column, feature.row);
    }
    return OpenCvWindows(MatOf(image), corners);
  };
  const cv::Mat first = windows_of(Pair().first);
  const cv::Mat second = windows_of(Pair().second);
  std::size_t matches = 0;
  for ([[maybe_unused]] auto _ : state) matches = OpenCvMatches(first, second).size();
  state.counters["matches"] = static_cast<double>(matches);
  state.SetLabel("OpenCV " CV_VERSION);
}
BENCHMARK(OpenCvMatch)->Unit(benchmark::kMillisecond);

#endif  // ROCKYARD_HAS_OPENCV

}  // namespace
}  // namespace rockyard::vision
