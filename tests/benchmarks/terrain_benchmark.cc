// Cost of building fields and of asking them. Each benchmark prints a hash of what it computed.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/hash.h"
#include "terrain/field.h"
#include "terrain/field_hash.h"
#include "terrain/test_fields.h"

namespace rockyard::terrain {
namespace {

using math::Vector3;

// Nominal, Viking Lander 2, and that with pointed rocks.
constexpr std::array<std::string_view, 3> kFields = {"nominal ", "vl2 ", "vl2 pointed "};

TerrainParams Params(const benchmark::State& state) {
  TerrainParams params;
  params.rocks.k_per_m2 = state.range(0) == 0 ? kNominalK : kVikingLander2K;
  params.rocks.pointedness = state.range(0) == 2 ? 0.87 : 0.0;
  return params;
}

void Label(benchmark::State& state, std::uint64_t hash) {
  state.SetLabel(std::string(kFields[static_cast<std::size_t>(state.range(0))]) + core::Hex(hash));
}

void BM_BuildField(benchmark::State& state) {
  const TerrainParams params = Params(state);
  std::uint32_t trial = 0;
  for (auto _ : state) benchmark::DoNotOptimize(BuildField(params, {1, trial++}, {}));
  Label(state, HashRocks(BuildField(params, {1, 0}, {}).terrain));
}
BENCHMARK(BM_BuildField)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

struct Ray {
  Vector3 origin_W;
  Vector3 direction_W;
};

// Rays like those of a light stripe: from 0.25 m above the ground, downwards, about 0.5 m long.
std::vector<Ray> StripeRays(double x_m) {
  std::vector<Ray> rays;
  for (int i = 0; i < 60; ++i) {
    const double azimuth = -0.8 + 1.6 * i / 59.0;
    const Vector3 direction(std::cos(azimuth), std::sin(azimuth), -0.8 - 0.005 * i);
    rays.push_back({{x_m, 0.0, 0.25}, direction.normalized()});
  }
  return rays;
}

// One scan of 60 rays per iteration, at places along the course; `local` gathers candidates first.
void Scan(benchmark::State& state, bool local) {
  const Terrain terrain = BuildField(Params(state), {1, 0}, {}).terrain;
  std::vector<std::vector<Ray>> scans;
  for (int i = 0; i < 100; ++i) scans.push_back(StripeRays(0.6 + 0.06 * i));
  std::vector<int> near;
  const auto cast = [&](const std::vector<Ray>& rays, auto&& use) {
    if (local) terrain.RocksNear(rays[0].origin_W.x() + 0.2, rays[0].origin_W.y(), 0.5, near);
    for (const Ray& ray : rays) {
      use(local ? terrain.CastRay(ray.origin_W, ray.direction_W, 1.0, near)
                : terrain.CastRay(ray.origin_W, ray.direction_W, 1.0));
    }
  };
  std::size_t scan = 0;
  for (auto _ : state) {
    cast(scans[scan++ % scans.size()], [](const auto& hit) { benchmark::DoNotOptimize(hit); });
  }
  core::Hasher hasher;
  for (const auto& rays : scans) {
    cast(rays, [&hasher](const auto& hit) { hasher.Real(hit ? hit->distance_m : -1.0); });
  }
  Label(state, hasher.value());
}
void BM_ScanOnGrid(benchmark::State& state) { Scan(state, false); }
void BM_ScanAmongCandidates(benchmark::State& state) { Scan(state, true); }
BENCHMARK(BM_ScanOnGrid)->Arg(0)->Arg(1)->Arg(2);
BENCHMARK(BM_ScanAmongCandidates)->Arg(0)->Arg(1)->Arg(2);

void BM_Height(benchmark::State& state) {
  const Terrain terrain = BuildField(Params(state), {1, 0}, {}).terrain;
  double x_m = 0.0;
  for (auto _ : state) {
    x_m = x_m > 7.0 ? 0.0 : x_m + 0.0137;
    benchmark::DoNotOptimize(terrain.Height(x_m, 0.3));
  }
  core::Hasher hasher;
  for (int i = 0; i < 700; ++i) hasher.Real(terrain.Height(0.01 * i, 0.3));
  Label(state, hasher.value());
}
BENCHMARK(BM_Height)->Arg(0)->Arg(1)->Arg(2);

void BM_RoughRay(benchmark::State& state) {
  GroundParams params;
  params.roughness_rms_m = 0.02;
  const Ground ground(params, {1, 0});
  const std::vector<Ray> rays = StripeRays(1.0);
  std::size_t ray = 0;
  for (auto _ : state) {
    const Ray& next = rays[ray++ % rays.size()];
    benchmark::DoNotOptimize(ground.CastRay(next.origin_W, next.direction_W, 1.0));
  }
  core::Hasher hasher;
  for (const Ray& each : rays) {
    hasher.Real(ground.CastRay(each.origin_W, each.direction_W, 1.0).value_or(-1.0));
  }
  state.SetLabel(core::Hex(hasher.value()));
}
BENCHMARK(BM_RoughRay);

}  // namespace
}  // namespace rockyard::terrain
