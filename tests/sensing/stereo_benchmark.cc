// Time per stereo look. Each run prints a hash of the points, so that a faster sensor that sees
// something else does not pass unnoticed.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/hash.h"
#include "core/random.h"
#include "stereo_scene.h"
#include "terrain/field.h"

namespace rockyard::sensing {
namespace {

constexpr int kHashedLooks = 28;

// Rocks of 10 to 60 cm at `per_m2` in a square of 16 m; sizes after N ~ D^-2.66.
terrain::Terrain RandomField(double per_m2, double roughness_m) {
  core::RandomStream stream({7, 0}, core::Purpose::kTest, 2);
  terrain::GroundParams ground{.roughness_rms_m = roughness_m};
  std::vector<terrain::Rock> rocks;
  constexpr double kSide_m = 16.0;
  const auto count = static_cast<int>(per_m2 * kSide_m * kSide_m);
  for (int i = 0; i < count; ++i) {
    const double radius = std::min(0.05 * std::pow(stream.Uniform(), -1.0 / 2.66), 0.3);
    const double x = core::SampleUniform(stream, -0.5 * kSide_m, 0.5 * kSide_m);
    const double y = core::SampleUniform(stream, -0.5 * kSide_m, 0.5 * kSide_m);
    const double yaw = core::SampleUniform(stream, 0.0, 3.0);
    rocks.push_back(EllipsoidRock(x, y, 0.2 * radius, radius, 0.8 * radius, 0.6 * radius, yaw));
  }
  return {terrain::Ground(ground, {7, 0}), std::move(rocks), {}};
}

// Terrain of the published runs: Moore's law in the virtual arena.
terrain::Terrain MooreField(double k_per_m2) {
  terrain::TerrainParams params{
      .rocks = {.kind = terrain::RockFieldKind::kMoore, .k_per_m2 = k_per_m2},
      .arena = {.kind = terrain::ArenaKind::kVirtualReflected}};
  return terrain::BuildField(params, {1, 0}, {}).terrain;
}

// 35 cm on for each look, as after an arc.
messages::PointCloud LookAt(const StereoSensor& sensor, const terrain::Terrain& terrain,
                            std::int64_t number) {
  const auto step = static_cast<double>(number % kHashedLooks);
  const math::Transform X_WR =
      math::MakePose({0.27 * step, 0.1 * std::sin(step), 0.1}, 0.4 * std::cos(step), 0.02, -0.03);
  return sensor.Look(terrain, X_WR, {1, 0}, number, messages::LookDirection::kAhead);
}

void Look(benchmark::State& state, const terrain::Terrain& terrain, const StereoParams& params) {
  const StereoSensor sensor(params);
  core::Hasher hash;
  std::size_t points = 0;
  for (std::int64_t number = 0; number < kHashedLooks; ++number) {
    const messages::PointCloud cloud = LookAt(sensor, terrain, number);
    points += cloud.points_R.size();
    for (const math::Vector3& p_R : cloud.points_R) hash.Real(p_R.x()).Real(p_R.y()).Real(p_R.z());
  }
  std::int64_t number = 0;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(LookAt(sensor, terrain, number++));
  state.counters["points"] = static_cast<double>(points) / kHashedLooks;
  state.SetLabel("hash " + core::Hex(hash.value()));
}

void BM_Look(benchmark::State& state) {
  Look(state, RandomField(static_cast<double>(state.range(0)), 0.0), {});
}
BENCHMARK(BM_Look)->ArgName("rocks_per_m2")->Arg(0)->Arg(2)->Arg(6)->Unit(benchmark::kMicrosecond);

void BM_LookIdeal(benchmark::State& state) {
  Look(state, RandomField(static_cast<double>(state.range(0)), 0.0), IdealStereo());
}
BENCHMARK(BM_LookIdeal)->ArgName("rocks_per_m2")->Arg(0)->Arg(6)->Unit(benchmark::kMicrosecond);

void BM_LookErrorsAlike(benchmark::State& state) {
  StereoParams params{.noise_window_px = 7, .mismatch_probability = 0.01};
  Look(state, RandomField(2.0, 0.0), params);
}
BENCHMARK(BM_LookErrorsAlike)->Unit(benchmark::kMicrosecond);

void BM_LookRoughGround(benchmark::State& state) { Look(state, RandomField(2.0, 0.02), {}); }
BENCHMARK(BM_LookRoughGround)->Unit(benchmark::kMicrosecond);

void BM_LookMoore(benchmark::State& state, double k_per_m2) {
  Look(state, MooreField(k_per_m2), {});
}
BENCHMARK_CAPTURE(BM_LookMoore, nominal, 0.00415)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_LookMoore, vl2, 0.013)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace rockyard::sensing
