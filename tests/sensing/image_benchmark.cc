// Time per scan of the imager. Each run prints a hash of the counts, so that a faster imager that
// makes other images does not pass unnoticed.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

#include "core/hash.h"
#include "core/random.h"
#include "image_kit.h"

namespace rockyard::sensing {
namespace {

// Rocks of 10 to 60 cm at `per_m2` in a square of 8 m; sizes after N ~ D^-2.66.
terrain::Terrain RandomField(double per_m2, double roughness_rms_m) {
  core::RandomStream stream({7, 0}, core::Purpose::kTest, 1);
  std::vector<terrain::Rock> rocks;
  constexpr double kSide_m = 8.0;
  const auto count = static_cast<int>(per_m2 * kSide_m * kSide_m);
  for (int i = 0; i < count; ++i) {
    const double radius = std::min(0.05 * std::pow(stream.Uniform(), -1.0 / 2.66), 0.3);
    const double x = core::SampleUniform(stream, 0.0, kSide_m);
    const double y = core::SampleUniform(stream, -0.5 * kSide_m, 0.5 * kSide_m);
    const double yaw = core::SampleUniform(stream, 0.0, 3.0);
    rocks.push_back(EllipsoidRock(x, y, 0.2 * radius, radius, 0.8 * radius, 0.6 * radius, yaw));
  }
  terrain::GroundParams ground{.roughness_rms_m = roughness_rms_m};
  return {terrain::Ground(ground, {7, 0}), std::move(rocks), {}};
}

math::Transform PoseOf(std::int64_t scan) {
  const auto step = static_cast<double>(scan % 100);
  return PoseAt(0.5 + 0.065 * step, 3.0 * std::sin(0.1 * step), 0.0, 0.3 * std::cos(step));
}

void ScanTheField(benchmark::State& state, const SunParams& sun, double roughness_rms_m) {
  const terrain::Terrain terrain =
      RandomField(static_cast<double>(state.range(0)), roughness_rms_m);
  const StripeImager imager(LightStripeParams{}, sun, rover::RoverGeometryParams{});
  core::Hasher hash;
  constexpr std::int64_t kHashedScans = 10;
  std::int64_t number = 0;
  for (; number < kHashedScans; ++number) {
    for (const auto& exposure : imager.Expose(terrain, PoseOf(number), {1, 0}, number).exposures) {
      for (const auto& band : exposure.lit) {
        for (const std::uint16_t count : band.counts) hash.Integer(count);
      }
    }
  }
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(imager.Expose(terrain, PoseOf(number), {1, 0}, number));
    ++number;
  }
  state.SetLabel("hash " + core::Hex(hash.value()));
}

void BM_Expose(benchmark::State& state) {
  const SunParams sun{.elevation_rad = math::DegToRad(static_cast<double>(state.range(1)))};
  ScanTheField(state, sun, 0.0);
}
BENCHMARK(BM_Expose)
    ->ArgNames({"rocks_per_m2", "sun_deg"})
    ->ArgsProduct({{0, 2, 6, 20}, {60}})
    ->Args({6, 15})
    ->Unit(benchmark::kMillisecond);

void BM_ExposeOnRoughGround(benchmark::State& state) { ScanTheField(state, SunParams{}, 0.01); }
BENCHMARK(BM_ExposeOnRoughGround)->ArgName("rocks_per_m2")->Arg(2)->Unit(benchmark::kMillisecond);

void BM_MakeImager(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(
        StripeImager(LightStripeParams{}, SunParams{}, rover::RoverGeometryParams{}));
  }
}
BENCHMARK(BM_MakeImager)->Unit(benchmark::kMillisecond);

void BM_FullFrame(benchmark::State& state) {
  const terrain::Terrain terrain = RandomField(2.0, 0.0);
  const StripeImager imager(LightStripeParams{}, SunParams{}, rover::RoverGeometryParams{});
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(imager.FullFrame(terrain, PoseOf(0), {1, 0}, 0, 0, 0));
  }
}
BENCHMARK(BM_FullFrame)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockyard::sensing
