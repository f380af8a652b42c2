#include "statistics/bootstrap.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/random.h"
#include "statistics/quantiles.h"

namespace rockyard::statistics {

Interval BootstrapInterval(std::span<const double> sample, const Statistic& statistic,
                           std::uint64_t seed, double confidence, std::size_t replicates) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> values = SortedFinite(sample);
  if (values.empty()) return {kNaN, kNaN};
  const double n = static_cast<double>(values.size());
  std::vector<double> resample(values.size());
  std::vector<double> statistics(replicates);
  for (std::size_t b = 0; b < replicates; ++b) {
    core::RandomStream stream({.seed = seed, .trial = 0}, core::Purpose::kBootstrap,
                              static_cast<std::uint32_t>(b));
    for (double& x : resample) x = values[static_cast<std::size_t>(stream.Uniform() * n)];
    std::sort(resample.begin(), resample.end());
    statistics[b] = statistic(resample);
  }
  const std::vector<double> sorted = SortedFinite(statistics);
  const double tail = 0.5 * (1.0 - confidence);
  return {Quantile(sorted, tail), Quantile(sorted, 1.0 - tail)};
}

}  // namespace rockyard::statistics
