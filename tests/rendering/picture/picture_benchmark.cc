// CPU time of a stereo pair of 512 x 512 pixels, over the rocks of the law. Each run prints a hash
// of both images.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "core/hash.h"
#include "rendering/picture/picture_kit.h"
#include "rendering/picture/picture_readout.h"
#include "terrain/field.h"
#include "vision/each_pixel.h"

namespace rockyard::rendering {
namespace {

constexpr int kSide = 512;
constexpr core::TrialKey kKey{7, 0};

terrain::Terrain MarsWith(double k_per_m2, double roughness_rms_m) {
  terrain::TerrainParams params;
  params.rocks.k_per_m2 = k_per_m2;
  params.arena.kind = terrain::ArenaKind::kOpen;
  params.ground.roughness_rms_m = roughness_rms_m;
  return terrain::BuildField(params, kKey, terrain::Course{}).terrain;
}

struct Pair {
  explicit Pair(const terrain::Terrain& terrain_in) : terrain(terrain_in) {
    sun.elevation_rad = math::DegToRad(40.0);
    for (int eye = 0; eye < 2; ++eye) {
      const vision::CameraModel camera = PinholeAt(
          {0.0, 0.1 - 0.2 * eye, 1.0}, math::DegToRad(20.0), kSide, kSide, math::DegToRad(45.0));
      rays.emplace_back(camera);
      readouts.emplace_back(params.camera, rays.back(), eye, kKey);
    }
  }

  // Everything that a pose needs: the scene, textures, both pictures and their read-outs.
  void Render(core::Hasher* hash) const {
    const PictureScene scene(terrain, sun, params.look, params.camera.imager.filter_width_m, {});
    TerrainLook look(terrain, sun, params.look, kKey);
    for (std::size_t eye = 0; eye < 2; ++eye) {
      Picture picture(kSide, kSide);
      PictureRenderer(scene, params.look, rays[eye], math::Transform::Identity())
          .RenderRows(0, kSide, look, picture);
      const auto rates = readouts[eye].Rates(picture);
      const RawImage raw =
          readouts[eye].Read(rates, readouts[eye].Exposure(rates), static_cast<ImageNumber>(eye));
      benchmark::DoNotOptimize(raw.counts.values().data());
      if (hash == nullptr) continue;
      for (const std::uint16_t count : raw.counts.values()) hash->Integer(count);
    }
  }

  const terrain::Terrain& terrain;
  SunParams sun;
  PictureParams params;
  std::vector<PixelRays> rays;
  std::vector<PictureReadout> readouts;
};

void RenderPairs(benchmark::State& state, const terrain::Terrain& terrain,
                 const LookParams& look = {}) {
  Pair pair(terrain);
  pair.params.look = look;
  core::Hasher hash;
  pair.Render(&hash);
  for ([[maybe_unused]] auto _ : state) pair.Render(nullptr);
  state.SetLabel("hash " + core::Hex(hash.value()));
}

void BM_Pair(benchmark::State& state) {
  RenderPairs(state, MarsWith(state.range(0) == 0 ? 0.00415 : 0.013, 0.0));
}
BENCHMARK(BM_Pair)->ArgName("vl2")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

void BM_PairWithJaggedEdges(benchmark::State& state) {
  const LookParams look{.edge_samples = 1};
  RenderPairs(state, MarsWith(0.013, 0.0), look);
}
BENCHMARK(BM_PairWithJaggedEdges)->Unit(benchmark::kMillisecond);

// Radiance of the left image, means over squares of `side` pixels, as a pyramid reduces images.
std::vector<double> Reduced(const terrain::Terrain& terrain, const LookParams& look, int side) {
  const Pair pair(terrain);
  const PictureScene scene(terrain, pair.sun, look, pair.params.camera.imager.filter_width_m, {});
  TerrainLook seen(terrain, pair.sun, look, kKey);
  Picture picture(kSide, kSide);
  PictureRenderer(scene, look, pair.rays.front(), math::Transform::Identity())
      .RenderRows(0, kSide, seen, picture);
  std::vector<double> reduced(static_cast<std::size_t>(kSide / side) * (kSide / side));
  vision::ForEachPixel(kSide, kSide, [&](int column, int row) {
    reduced[static_cast<std::size_t>(row / side * (kSide / side) + column / side)] +=
        static_cast<double>(picture.radiance_w_m2_sr.At(column, row)) / (side * side);
  });
  return reduced;
}

// What fewer samples save, and how far their images are from those of 16 x 16 samples and 16 taps:
// root mean square over the mean, as rendered and reduced to a quarter each way.
void BM_PairOfFewSamples(benchmark::State& state) {
  const terrain::Terrain terrain = MarsWith(0.013, 0.0);
  LookParams look{.edge_samples = state.range(0), .texture_taps = state.range(1)};
  LookParams finest;
  finest.edge_samples = finest.texture_taps = 16;
  Pair pair(terrain);
  pair.params.look = look;
  for ([[maybe_unused]] auto _ : state) pair.Render(nullptr);
  for (const int side : {1, 4}) {
    const std::vector<double> here = Reduced(terrain, look, side);
    const std::vector<double> best = Reduced(terrain, finest, side);
    double squares = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      squares += (here[i] - best[i]) * (here[i] - best[i]);
      mean += best[i];
    }
    const auto count = static_cast<double>(here.size());
    state.counters[side == 1 ? "off" : "off_reduced"] = std::sqrt(squares / count) / (mean / count);
  }
}
BENCHMARK(BM_PairOfFewSamples)
    ->ArgNames({"edge", "taps"})
    ->Args({4, 8})
    ->Args({2, 8})
    ->Args({1, 8})
    ->Args({4, 4})
    ->Args({1, 4})
    ->Args({1, 2})
    ->Unit(benchmark::kMillisecond);

void BM_PairOnRoughGround(benchmark::State& state) { RenderPairs(state, MarsWith(0.013, 0.01)); }
BENCHMARK(BM_PairOnRoughGround)->Unit(benchmark::kMillisecond);

// Once for a camera.
void BM_PixelRays(benchmark::State& state) {
  const vision::CameraModel camera =
      PinholeAt({0.0, 0.0, 1.0}, 0.3, kSide, kSide, math::DegToRad(45.0));
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(PixelRays(camera));
}
BENCHMARK(BM_PixelRays)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rockyard::rendering
