#include "statistics/exponential_tail.h"

#include <algorithm>
#include <cmath>

#include "core/distributions.h"
#include "core/random.h"
#include "statistics/quantiles.h"

namespace rockyard::statistics {

double ExponentialStatistic(std::span<const double> sorted, std::size_t skip) {
  constexpr std::size_t kFewest = 3;
  if (sorted.size() < skip + 1 + kFewest) return 0.0;
  const double offset = sorted[skip];
  const std::span<const double> above = sorted.subspan(skip + 1);
  const double n = static_cast<double>(above.size());
  double mean = 0.0;
  for (const double x : above) mean += (x - offset) / n;
  if (!(mean > 0.0)) return 0.0;
  double statistic = 0.0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    // F = 1 - e^(-(x - offset)/mean), and D as in the one-sample test.
    const double f = -std::expm1(-(above[i] - offset) / mean);
    statistic =
        std::max({statistic, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
  }
  return statistic;
}

std::vector<double> ExponentialNullLaw(std::size_t excesses, std::size_t replicates,
                                       std::uint64_t seed) {
  std::vector<double> null(replicates);
  std::vector<double> sample(excesses + 1);
  for (std::size_t b = 0; b < replicates; ++b) {
    core::RandomStream stream({.seed = seed, .trial = 0}, core::Purpose::kBootstrap,
                              static_cast<std::uint32_t>(b));
    // The offset is an order statistic: excesses over it are exponential again, so it may be 0 and
    // the mean 1 without loss.
    sample[0] = 0.0;
    for (std::size_t i = 1; i < sample.size(); ++i)
      sample[i] = core::SampleExponential(stream, 1.0);
    std::sort(sample.begin(), sample.end());
    null[b] = ExponentialStatistic(sample);
  }
  std::sort(null.begin(), null.end());
  return null;
}

double BootstrapPValue(std::span<const double> ascending_null, double statistic) {
  const auto first = std::lower_bound(ascending_null.begin(), ascending_null.end(), statistic);
  const auto reached = static_cast<double>(ascending_null.end() - first);
  // The observed statistic counts as one more replicate.
  return (1.0 + reached) / (1.0 + static_cast<double>(ascending_null.size()));
}

TestResult ExponentialTailTest(std::span<const double> sample, std::uint64_t seed, std::size_t skip,
                               std::size_t replicates) {
  const std::vector<double> sorted = SortedFinite(sample);
  if (sorted.size() <= skip + 1) return {};
  const double statistic = ExponentialStatistic(sorted, skip);
  // The null law depends on the number of excesses alone.
  const std::vector<double> null = ExponentialNullLaw(sorted.size() - skip - 1, replicates, seed);
  return {statistic, BootstrapPValue(null, statistic)};
}

}  // namespace rockyard::statistics
