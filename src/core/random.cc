#include "core/random.h"

#include <Random123/philox.h>

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/normal_pieces.h"
#include "math/functions.h"

namespace rockyard::core {

std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                        std::array<std::uint32_t, 2> key) {
  r123::Philox4x32 generator;
  const r123::Philox4x32::ctr_type in{{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32::key_type k{{key[0], key[1]}};
  const auto out = generator(in, k);
  return {out[0], out[1], out[2], out[3]};
}

// Must stay: this layout of key and counter, on which every record depends; a test pins it.
RandomStream::RandomStream(TrialKey key, Purpose purpose, std::uint32_t substream)
    : key_{static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32)},
      counter_{0, substream, static_cast<std::uint32_t>(purpose), key.trial} {}

std::uint32_t RandomStream::NextU32() {
  if (next_ == 4) {
    block_ = Philox4x32(counter_, key_);
    ++counter_[0];
    next_ = 0;
  }
  return block_[static_cast<std::size_t>(next_++)];
}

std::uint64_t RandomStream::NextU64() {
  const std::uint64_t high = NextU32();
  return (high << 32) | NextU32();
}

double RandomStream::Uniform() {
  constexpr double kCell = 0x1.0p-52;
  return (static_cast<double>(NextU64() >> 12) + 0.5) * kCell;
}

namespace {

// exp(-200) is far above the smallest double, so sequential inversion stays exact below this mean.
constexpr double kLargestInvertedMean = 200.0;

std::int64_t InvertPoisson(RandomStream& stream, double mean) {
  const double u = stream.Uniform();
  double probability = math::Exp(-mean);
  double cumulative = probability;
  std::int64_t count = 0;
  // The bound ends the loop where rounding keeps the sum below u: 1000 is 50 sigma above 200.
  while (u > cumulative && count < 1000) {
    ++count;
    probability *= mean / static_cast<double>(count);
    cumulative += probability;
  }
  return count;
}

}  // namespace

double SampleUniform(RandomStream& stream, double low, double high) {
  EXPECT(low <= high);
  return low + (high - low) * stream.Uniform();
}

namespace {

// Returns NormalQuantile(p) to rounding.
double PiecewiseQuantile(double p) {
  static const NormalPieces kPieces;
  // Exact: uniform numbers have 53 bits behind the point.
  const double beyond = std::min(p, 1.0 - p);
  if (beyond < NormalPieces::kLeast) return NormalQuantile(p);
  return std::copysign(kPieces.Exceeded(beyond), p - 0.5);
}

}  // namespace

double SampleNormal(RandomStream& stream, double mean, double standard_deviation) {
  EXPECT(standard_deviation >= 0.0);
  return mean + standard_deviation * PiecewiseQuantile(stream.Uniform());
}

double SampleExponential(RandomStream& stream, double mean) {
  EXPECT(mean > 0.0);
  return -mean * math::Log(stream.Uniform());
}

bool SampleBernoulli(RandomStream& stream, double probability) {
  EXPECT(probability >= 0.0 && probability <= 1.0);
  return stream.Uniform() < probability;
}

std::int64_t SamplePoisson(RandomStream& stream, double mean) {
  EXPECT(mean >= 0.0 && std::isfinite(mean));
  std::int64_t count = 0;
  double rest = mean;
  for (; rest > kLargestInvertedMean; rest -= kLargestInvertedMean) {
    count += InvertPoisson(stream, kLargestInvertedMean);
  }
  return count + (rest > 0.0 ? InvertPoisson(stream, rest) : 0);
}

}  // namespace rockyard::core
