// Time of whole steps of visual odometry: detection in one new left image, matching with the
// keyframe, places from the right eye, selection and least squares (Howard 2012 section 3: 512 x
// 384 pixels, 400 features).
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <string>

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

// With the motion predicted (1), as on a rover, or not (0: features are matched twice). Stages are
// told in us.
void Step(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  OdometerParams params;
  params.keyframe.min_share = 0.0;
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
  std::optional<math::Transform> predicted;
  if (state.range(0) == 1) predicted = math::MakePose({0.06, 0.0, 0.0}, 0.0, 0.0, 0.0);
  OdometryStep step;
  for (auto _ : state) {
    AlignedImages images = Images()[1];
    last = Clock::now();
    step = odometer.Add(std::move(images), predicted);
    benchmark::DoNotOptimize(step);
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
BENCHMARK(Step)->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockyard::vision
