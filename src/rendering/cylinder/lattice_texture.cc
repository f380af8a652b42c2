#include "rendering/cylinder/lattice_texture.h"

#include <algorithm>
#include <cmath>

#include "rendering/pixel_noise.h"

namespace rockyard::rendering {
namespace {

constexpr double kFinest_m = 0.004;
constexpr int kOctavesOfLine = 5;
// Lattices repeat after 2^15 nodes, the range of PixelNoise.
constexpr int kPeriod = 1 << 15;

int Wrapped(std::int64_t node) { return static_cast<int>(node & (kPeriod - 1)); }

}  // namespace

double LatticeTexture::SpacingOf(int octave) { return std::ldexp(kFinest_m, octave); }

void LatticeTexture::AddOctave(const TextureLine& line, int octave, double deviation,
                               std::span<float> values) {
  const double spacing_m = SpacingOf(octave);
  const PixelNoise noise(key_, core::Purpose::kCylinderGround, static_cast<std::uint32_t>(octave));
  const auto pixels = static_cast<double>(values.size());
  const double first = line.first_v_m / spacing_m;
  const double step = line.step_v_m / spacing_m;
  const double last = first + step * (pixels - 1.0);
  const auto low = static_cast<std::int64_t>(std::floor(std::fmin(first, last)));
  const auto high = static_cast<std::int64_t>(std::floor(std::fmax(first, last))) + 1;
  const double u = line.u_m / spacing_m;
  const double row = std::floor(u);
  const auto share = static_cast<float>(u - row);
  // Nodes come by eights, from a multiple of eight on.
  const std::int64_t start = low - (low & (PixelNoise::kBlock - 1));
  nodes_.clear();
  for (std::int64_t node = start; node <= high; node += PixelNoise::kBlock) {
    const int block = PixelNoise::BlockOf(Wrapped(node));
    const auto here = noise.Block(Wrapped(static_cast<std::int64_t>(row)), block);
    const auto next = noise.Block(Wrapped(static_cast<std::int64_t>(row) + 1), block);
    for (std::size_t i = 0; i < here.size(); ++i) {
      nodes_.push_back((1.0F - share) * here[i] + share * next[i]);
    }
  }
  // Linear interpolation has 2/3 of the nodes' variance along either axis, on average.
  const auto scale = static_cast<float>(1.5 * deviation);
  double place = first - static_cast<double>(start);
  for (float& value : values) {
    const auto node = static_cast<std::size_t>(place);
    const auto way = static_cast<float>(place - static_cast<double>(node));
    value += scale * ((1.0F - way) * nodes_[node] + way * nodes_[node + 1]);
    place += step;
  }
}

void LatticeTexture::AddTo(const TextureLine& line, double deviation, std::span<float> values) {
  const double least_m = 2.0 * std::abs(line.step_v_m);
  const double level = std::log2(std::fmax(least_m / kFinest_m, 1.0));
  const int first = static_cast<int>(std::ceil(level));
  const double fade = static_cast<double>(first) - level;
  const double each = deviation / std::sqrt(static_cast<double>(kOctavesOfLine));
  for (int k = 0; k <= kOctavesOfLine; ++k) {
    const double weight = k == 0 ? fade : (k == kOctavesOfLine ? 1.0 - fade : 1.0);
    if (weight <= 0.0) continue;
    const double spacing_m = SpacingOf(first + k);
    const double kept = std::sqrt(std::fmin(1.0, spacing_m / line.footprint_u_m));
    AddOctave(line, first + k, each * weight * kept, values);
  }
}

}  // namespace rockyard::rendering
