#include "statistics/bootstrap.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "core/check.h"
#include "core/numbers.h"
#include "core/random.h"
#include "statistics/quantiles.h"

namespace rockyard::statistics {
namespace {

// Resamples that are summed side by side: the divisions of a running mean wait for each other, and
// those of other resamples fill the time.
constexpr std::size_t kLanes = 8;

using Uniforms = std::array<std::vector<double>, kLanes>;
// One resample per lane.
using Positions = std::vector<std::array<std::uint32_t, kLanes>>;

core::RandomStream StreamOf(std::uint64_t seed, std::size_t replicate) {
  return {
      {.seed = seed, .trial = 0}, core::Purpose::kBootstrap, static_cast<std::uint32_t>(replicate)};
}

std::size_t Drawn(double uniform, std::size_t count) {
  return static_cast<std::size_t>(uniform * static_cast<double>(count));
}

Interval PercentileInterval(std::span<const double> statistics, double confidence) {
  const std::vector<double> sorted = SortedFinite(statistics);
  // The quantiles of the replicates at both tails.
  const double tail = 0.5 * (1.0 - confidence);
  return {Quantile(sorted, tail), Quantile(sorted, 1.0 - tail)};
}

// Lanes beyond the last replicate draw too, and are left out later.
void DrawUniforms(std::uint64_t seed, std::size_t first_replicate, std::size_t count,
                  Uniforms& uniforms) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    core::RandomStream stream = StreamOf(seed, first_replicate + lane);
    uniforms[lane].resize(count);
    for (double& uniform : uniforms[lane]) uniform = stream.Uniform();
  }
}

// Which of `count` ascending values each resample holds, ascending: counted instead of sorted.
void PlacePositions(const Uniforms& uniforms, std::size_t count, Positions& positions) {
  positions.resize(count);
  std::vector<std::uint32_t> times(count);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    // How often each value is drawn; written out in order that gives the sorted resample.
    std::fill(times.begin(), times.end(), 0U);
    for (std::size_t i = 0; i < count; ++i) ++times[Drawn(uniforms[lane][i], count)];
    std::size_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
      for (std::uint32_t t = 0; t < times[i]; ++t) {
        positions[next++][lane] = static_cast<std::uint32_t>(i);
      }
    }
  }
}

// The running mean of Moments, lane by lane.
std::array<double, kLanes> MeansOf(const std::vector<double>& values, const Positions& positions) {
  std::array<double, kLanes> means{};
  double count = 0.0;
  for (const std::array<std::uint32_t, kLanes>& at : positions) {
    count += 1.0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      means[lane] += (values[at[lane]] - means[lane]) / count;
    }
  }
  return means;
}

struct MeanSample {
  std::size_t place = 0;       // among all samples
  std::vector<double> values;  // finite, ascending
  std::vector<double> means;   // of the resamples
};

using SamplesBySize = std::map<std::size_t, std::vector<MeanSample>>;

void AddMeans(const Positions& positions, std::size_t replicates, MeanSample& sample) {
  for (const double mean : MeansOf(sample.values, positions)) {
    // The last block of lanes may reach beyond the replicates.
    if (sample.means.size() < replicates) sample.means.push_back(mean);
  }
}

void Resample(std::uint64_t seed, std::size_t replicates, SamplesBySize& sizes) {
  if (sizes.empty()) return;
  Uniforms uniforms;
  Positions positions;
  for (std::size_t first = 0; first < replicates; first += kLanes) {
    DrawUniforms(seed, first, sizes.rbegin()->first, uniforms);
    for (auto& [size, samples] : sizes) {
      PlacePositions(uniforms, size, positions);
      for (MeanSample& sample : samples) AddMeans(positions, replicates, sample);
    }
  }
}

}  // namespace

Interval BootstrapInterval(std::span<const double> sample, const Statistic& statistic,
                           std::uint64_t seed, double confidence, std::size_t replicates) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  using core::kNaN;
  const std::vector<double> values = SortedFinite(sample);
  if (values.empty()) return {kNaN, kNaN};
  std::vector<double> resample(values.size());
  std::vector<double> statistics(replicates);
  for (std::size_t b = 0; b < replicates; ++b) {
    core::RandomStream stream = StreamOf(seed, b);
    for (double& x : resample) x = values[Drawn(stream.Uniform(), values.size())];
    std::sort(resample.begin(), resample.end());
    statistics[b] = statistic(resample);
  }
  return PercentileInterval(statistics, confidence);
}

std::vector<Interval> BootstrapMeanIntervals(std::span<const std::vector<double>> samples,
                                             std::uint64_t seed, double confidence,
                                             std::size_t replicates) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  using core::kNaN;
  std::vector<Interval> intervals(samples.size(), {kNaN, kNaN});
  SamplesBySize sizes;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::vector<double> values = SortedFinite(samples[i]);
    if (values.empty()) continue;
    if (values.front() == values.back()) {
      // Every resample is the sample; + 0.0 as the running mean does, for the sign of zero.
      intervals[i] = {values.front() + 0.0, values.front() + 0.0};
      continue;
    }
    std::vector<MeanSample>& alike = sizes[values.size()];
    alike.push_back({.place = i, .values = std::move(values), .means = {}});
  }
  Resample(seed, replicates, sizes);
  for (const auto& [size, of_size] : sizes) {
    for (const MeanSample& sample : of_size) {
      intervals[sample.place] = PercentileInterval(sample.means, confidence);
    }
  }
  return intervals;
}

}  // namespace rockyard::statistics
