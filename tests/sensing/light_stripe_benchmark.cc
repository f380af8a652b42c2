// Time per scan. Each run prints a hash of the columns found, so that a faster sensor that finds
// something else does not pass unnoticed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/hash.h"
#include "core/random.h"
#include "stripe_scene.h"
#include "terrain/rock.h"

namespace rockyard::sensing {
namespace {

// Rocks of 10 to 60 cm at `per_m2` in a square of 8 m; sizes after N ~ D^-2.66. Ellipsoids, or caps
// of the same height and outline.
terrain::Terrain RandomField(double per_m2, double pointedness) {
  core::RandomStream stream({7, 0}, core::Purpose::kTest, 1);
  std::vector<terrain::Rock> rocks;
  constexpr double kSide_m = 8.0;
  const auto count = static_cast<int>(per_m2 * kSide_m * kSide_m);
  for (int i = 0; i < count; ++i) {
    const double radius = std::min(0.05 * std::pow(stream.Uniform(), -1.0 / 2.66), 0.3);
    const double x = core::SampleUniform(stream, 0.0, kSide_m);
    const double y = core::SampleUniform(stream, -0.5 * kSide_m, 0.5 * kSide_m);
    const double yaw = core::SampleUniform(stream, 0.0, 3.0);
    rocks.push_back(terrain::ShapeRock({.diameter_m = 2.0 * radius,
                                        .width_ratio = 0.8,
                                        .half_height_m = 0.6 * radius,
                                        .height_m = 0.8 * radius},
                                       pointedness));
    rocks.back().center_W.head<2>() << x, y;
    rocks.back().yaw_rad = yaw;
  }
  return FlatWith(std::move(rocks));
}

void Scan(benchmark::State& state, const LightStripeParams& params, double pointedness = 0.0) {
  const terrain::Terrain terrain = RandomField(static_cast<double>(state.range(0)), pointedness);
  const LightStripe sensor(params);
  core::Hasher hash;
  constexpr int kHashedScans = 1000;
  std::int64_t number = 0;
  const auto pose = [](std::int64_t i) {
    const auto step = static_cast<double>(i % kHashedScans);
    return PoseAt(0.5 + 0.0065 * step, 3.0 * std::sin(0.01 * step), 0.0, 0.3 * std::cos(step));
  };
  for (; number < kHashedScans; ++number) {
    const auto scan = sensor.Scan(terrain, pose(number), {1, 0}, number);
    for (const auto& pixel : scan.pixels.points()) {
      hash.Integer(pixel.detected).Real(pixel.column_px);
    }
  }
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(sensor.Scan(terrain, pose(number), {1, 0}, number));
    ++number;
  }
  state.SetLabel("hash " + core::Hex(hash.value()));
}

void BM_Scan(benchmark::State& state) { Scan(state, {}); }
BENCHMARK(BM_Scan)->ArgName("rocks_per_m2")->Arg(0)->Arg(2)->Arg(6)->Arg(20);

void BM_ScanPointedRocks(benchmark::State& state) { Scan(state, {}, 0.87); }
BENCHMARK(BM_ScanPointedRocks)->ArgName("rocks_per_m2")->Arg(6)->Arg(20);

// Curved scanlines.
void BM_ScanRadialLens(benchmark::State& state) {
  LightStripeParams params{.lens = messages::Lens::kEquidistant};
  Scan(state, params);
}
BENCHMARK(BM_ScanRadialLens)->ArgName("rocks_per_m2")->Arg(0)->Arg(6);

void BM_ScanAllErrors(benchmark::State& state) {
  LightStripeParams params{
      .missed_probability = 0.01, .outlier_persistence = 0.5, .column_noise_px = 0.5};
  Scan(state, params);
}
BENCHMARK(BM_ScanAllErrors)->ArgName("rocks_per_m2")->Arg(0)->Arg(6);

void BM_ScanDenseArray(benchmark::State& state) {
  LightStripeParams params{.row_subdivision = 2, .stripe_subdivision = 2};
  Scan(state, params);
}
BENCHMARK(BM_ScanDenseArray)->ArgName("rocks_per_m2")->Arg(0)->Arg(6);

}  // namespace
}  // namespace rockyard::sensing
