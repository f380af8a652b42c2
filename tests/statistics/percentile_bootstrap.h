// The percentile interval (Efron 1979) of any statistic, plainly: an oracle for smooth statistics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/random.h"
#include "statistics/quantiles.h"

namespace rockyard::statistics {

// One stream per replicate.
inline Interval BootstrapInterval(std::span<const double> sample,
                                  const std::function<double(std::span<const double>)>& statistic,
                                  std::uint64_t seed, double confidence = kConfidence,
                                  std::size_t replicates = 2000) {
  const std::vector<double> values = SortedFinite(sample);
  std::vector<double> resample(values.size());
  std::vector<double> statistics(replicates);
  for (std::size_t b = 0; b < replicates; ++b) {
    core::RandomStream stream({.seed = seed, .trial = 0}, core::Purpose::kTest,
                              static_cast<std::uint32_t>(b));
    for (double& x : resample) {
      x = values[static_cast<std::size_t>(stream.Uniform() * static_cast<double>(values.size()))];
    }
    std::sort(resample.begin(), resample.end());
    statistics[b] = statistic(resample);
  }
  std::sort(statistics.begin(), statistics.end());
  const double tail = 0.5 * (1.0 - confidence);
  return {Quantile(statistics, tail), Quantile(statistics, 1.0 - tail)};
}

}  // namespace rockyard::statistics
