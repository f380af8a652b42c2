// Time of whole steps of visual odometry: detection in one new left image, matching with the
// keyframe, places from the right eye, selection and least squares (Howard 2012 section 3: 512 x
// 384 pixels, 400 features).

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "vision/odometry/synthetic_sequence.h"

namespace rockyard::vision {
namespace {

constexpr ImageSize kSize{512, 384};

const std::array<AlignedImages, 2>& Images() {
  static const std::array<AlignedImages, 2> images{
      SeePlane(PlanePair(kSize), math::Transform::Identity(), {}, 0),
      SeePlane(PlanePair(kSize), math::MakePose({0.05, 0.0, 0.0}, 0.01, 0.0, 0.0), {}, 1)};
  return images;
}

// How a step is asked for.
enum Kind {
  kUnpredicted,  // features are matched twice
  kPredicted,    // as on a rover
  kRenewed,      // so, and every pair becomes the keyframe: there and back again
};

// Stages are told in us.
void Step(benchmark::State& state, Kind kind) {
  using Clock = std::chrono::steady_clock;
  OdometerParams params;
  params.keyframe.min_share = 0.0;
  if (kind == kRenewed) params.keyframe.max_way_m = 0.0;
  std::array<double, 6> stage_us{};
  Clock::time_point last;
  VisualOdometer odometer(params, PlanePair(kSize), {}, {1, 0}, [&](OdometryStage stage) {
    const Clock::time_point now = Clock::now();
    stage_us[static_cast<std::size_t>(stage)] +=
        std::chrono::duration<double, std::micro>(now - last).count();
    last = now;
  });
  odometer.Add(Images()[0]);
  stage_us = {};
  const math::Transform ahead = math::MakePose({0.06, 0.0, 0.0}, 0.0, 0.0, 0.0);
  OdometryStep step;
  std::size_t at = 1;
  for (auto _ : state) {
    AlignedImages images = Images()[at];
    std::optional<math::Transform> predicted;
    if (kind != kUnpredicted) predicted = at == 1 ? ahead : ahead.inverse();
    last = Clock::now();
    step = odometer.Add(std::move(images), predicted);
    benchmark::DoNotOptimize(step);
    if (kind == kRenewed) at = 1 - at;
  }
  constexpr std::array<const char*, 6> kNames{"detect", "match",    "place",
                                              "select", "estimate", "renew"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    state.counters[kNames[i]] = stage_us[i] / static_cast<double>(state.iterations());
  }
  state.counters["features"] = static_cast<double>(step.result.counts.features_second);
  state.counters["matches"] = static_cast<double>(step.result.counts.matches);
  state.counters["consistent"] = static_cast<double>(step.result.counts.consistent);
}
BENCHMARK_CAPTURE(Step, predicted, kPredicted)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Step, renewed, kRenewed)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Step, unpredicted, kUnpredicted)->Unit(benchmark::kMillisecond);

struct KnownStep {
  std::array<AlignedImages, 2> images;
  math::Transform X_FS;
};

// Steps of 5 to 30 cm with turns up to 6 deg, each over a texture of its own.
const std::vector<KnownStep>& KnownSteps() {
  static const std::vector<KnownStep> steps = [] {
    std::vector<KnownStep> made;
    core::RandomStream stream({258, 0}, core::Purpose::kTest, 0);
    for (std::uint32_t i = 0; i < 12; ++i) {
      const double way_m = core::SampleUniform(stream, 0.05, 0.3);
      const double turn_rad = core::SampleUniform(stream, -0.1, 0.1);
      const math::Transform X_FS = math::MakePose({way_m, 0.0, 0.0}, turn_rad, 0.01, -0.01);
      const PlaneWorld world{.number = i};
      const RectifiedPair pair = PlanePair(kSize);
      made.push_back(
          {{SeePlane(pair, math::Transform::Identity(), world, 0), SeePlane(pair, X_FS, world, 1)},
           X_FS});
    }
    return made;
  }();
  return steps;
}

// Howard 2012 section 2: more features, better poses, more time. Both pairs of a step and nothing
// predicted; errors are root mean squares over the steps.
void Features(benchmark::State& state) {
  OdometerParams params;
  params.detector.max_features = state.range(0) / params.detector.regions();
  params.detector.min_features = std::min<std::int64_t>(10, params.detector.max_features);
  const std::vector<KnownStep>& steps = KnownSteps();  // not timed
  double squares_m2 = 0.0, squares_rad2 = 0.0, features = 0.0, found = 0.0;
  for (auto _ : state) {
    for (const KnownStep& known : steps) {
      VisualOdometer odometer(params, PlanePair(kSize), {}, {1, 0});
      odometer.Add(known.images[0]);
      const OdometryStep step = odometer.Add(known.images[1]);
      features += static_cast<double>(step.features.size());
      if (!step.result.motion) continue;
      const math::Transform off = known.X_FS.inverse() * step.result.motion->X_FS;
      found += 1.0;
      squares_m2 += off.translation().squaredNorm();
      squares_rad2 += std::pow(Eigen::AngleAxisd(off.linear()).angle(), 2);
    }
  }
  const double motions = static_cast<double>(state.iterations()) * 12.0;
  state.counters["features"] = features / motions;
  state.counters["found"] = found / motions;
  state.counters["mm"] = 1e3 * std::sqrt(squares_m2 / found);
  state.counters["deg"] = math::RadToDeg(std::sqrt(squares_rad2 / found));
}
BENCHMARK(Features)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Arg(800)->Arg(1600)->Unit(
    benchmark::kMillisecond);

}  // namespace
}  // namespace rockyard::vision
