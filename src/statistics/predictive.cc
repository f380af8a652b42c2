#include "statistics/predictive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "statistics/sample_statistics.h"

namespace rockyard::statistics {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

constexpr std::size_t kOutermost = 10;

// Sum of the distances of the outermost values from the next one inwards; sign +1: upper end.
double OuterExcess(std::span<const double> ascending, double sign) {
  const std::size_t n = ascending.size();
  // Excesses of the ten outermost values over the eleventh.
  const std::size_t outer = std::min(n - 1, kOutermost);
  const double threshold = sign > 0.0 ? ascending[n - 1 - outer] : ascending[outer];
  double sum = 0.0;
  for (std::size_t i = 0; i < outer; ++i) {
    const double value = sign > 0.0 ? ascending[n - 1 - i] : ascending[i];
    sum += sign * (value - threshold);
  }
  return sum;
}

// Next excess of an exponential law of which `sum` S over k excesses is known (prior 1/mean):
// P(excess > e) = (1 + e/S)^-k, cut off at `room` e_0, by inverse CDF: with t = 1 - u (1 - P(e_0)),
// e = S (t^(-1/k) - 1).
double NextExcess(double u, double sum, double k, double room) {
  if (!(sum > 0.0)) return 0.0;
  const double beyond_room = std::pow(1.0 + room / sum, -k);
  const double tail = 1.0 - u * (1.0 - beyond_room);
  return sum * (std::pow(tail, -1.0 / k) - 1.0);
}

std::size_t UniformIndex(core::RandomStream& stream, std::size_t size) {
  return static_cast<std::size_t>(stream.Uniform() * static_cast<double>(size));
}

double ShareAtMost(std::span<const double> ascending, double value) {
  const auto end = std::upper_bound(ascending.begin(), ascending.end(), value);
  return (1.0 + static_cast<double>(end - ascending.begin())) /
         (1.0 + static_cast<double>(ascending.size()));
}

double ShareAtLeast(std::span<const double> ascending, double value) {
  const auto begin = std::lower_bound(ascending.begin(), ascending.end(), value);
  return (1.0 + static_cast<double>(ascending.end() - begin)) /
         (1.0 + static_cast<double>(ascending.size()));
}

// Share of replicates that are rejected where every one in turn, moved, is the published value.
template <typename Move>
double PowerWhereMoved(std::span<const double> ascending, double level, Move move) {
  double power = 0.0;
  const double n = static_cast<double>(ascending.size());
  for (const double s : ascending) {
    power += PredictivePValue(ascending, move(s), 0.0) <= level ? 1.0 / n : 0.0;
  }
  return power;
}

}  // namespace

PredictiveSampler::PredictiveSampler(std::span<const double> pool, double lower_limit)
    : pool_(SortedFinite(pool)) {
  EXPECT(pool_.size() >= 2);
  // Room for values below the pool, down to the limit of the support.
  lower_room_ = std::max(0.0, pool_.front() - lower_limit);
  lower_excess_ = OuterExcess(pool_, -1.0);
  upper_excess_ = OuterExcess(pool_, 1.0);
}

double PredictiveSampler::InGap(core::RandomStream& stream, std::size_t gap) const {
  const double u = stream.Uniform();
  const double k = static_cast<double>(std::min(pool_.size() - 1, kOutermost));
  // Below the smallest, above the largest, or evenly between two neighbours.
  if (gap == 0) return pool_.front() - NextExcess(u, lower_excess_, k, lower_room_);
  if (gap == pool_.size()) return pool_.back() + NextExcess(u, upper_excess_, k, kUnlimited);
  return pool_[gap - 1] + u * (pool_[gap] - pool_[gap - 1]);
}

void PredictiveSampler::Draw(core::RandomStream& stream, std::span<double> sample) const {
  const std::size_t gaps = pool_.size() + 1;
  std::vector<std::size_t> chosen(sample.size());
  for (std::size_t i = 0; i < sample.size(); ++i) {
    // Polya's urn: gaps start with one ball each, and every value adds one to the gap that it fell
    // into.
    const std::size_t ball = UniformIndex(stream, gaps + i);
    chosen[i] = ball < gaps ? ball : chosen[ball - gaps];
    sample[i] = InGap(stream, chosen[i]);
  }
  std::sort(sample.begin(), sample.end());
}

std::vector<double> PredictiveStatistics(std::span<const SamplePart> parts,
                                         const SampleStatistic& statistic, std::size_t replicates,
                                         core::TrialKey key) {
  std::size_t n = 0;
  for (const SamplePart& part : parts) n += part.n;
  std::vector<double> statistics(replicates);
  std::vector<double> sample(n);
  for (std::size_t b = 0; b < replicates; ++b) {
    core::RandomStream stream(key, core::Purpose::kBootstrap, static_cast<std::uint32_t>(b));
    std::span<double> rest = sample;
    for (const SamplePart& part : parts) {
      part.sampler->Draw(stream, rest.first(part.n));
      rest = rest.subspan(part.n);
    }
    std::sort(sample.begin(), sample.end());
    statistics[b] = statistic(sample);
  }
  return statistics;
}

std::vector<double> PredictiveStatistics(const PredictiveSampler& sampler, std::size_t n,
                                         const SampleStatistic& statistic, std::size_t replicates,
                                         core::TrialKey key) {
  const SamplePart whole{&sampler, n};
  return PredictiveStatistics({&whole, 1}, statistic, replicates, key);
}

double PredictivePValue(std::span<const double> ascending, double value, double rounding) {
  // All values that would round to the published one count on both sides.
  const double lower = ShareAtMost(ascending, value + 0.5 * rounding);
  const double upper = ShareAtLeast(ascending, value - 0.5 * rounding);
  return std::min(1.0, 2.0 * std::min(lower, upper));
}

double ShiftPower(std::span<const double> ascending, double shift, double level) {
  return std::min(PowerWhereMoved(ascending, level, [&](double s) { return s + shift; }),
                  PowerWhereMoved(ascending, level, [&](double s) { return s - shift; }));
}

double ScalePower(std::span<const double> ascending, double limit, double factor, double level) {
  const auto scaled = [&](double by) {
    return PowerWhereMoved(ascending, level, [&](double s) { return limit + (s - limit) * by; });
  };
  return std::min(scaled(factor), scaled(1.0 / factor));
}

}  // namespace rockyard::statistics
