// Percentile bootstrap intervals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// A statistic of a sample in ascending order.
using Statistic = std::function<double(std::span<const double>)>;

// Percentile interval (Efron 1979) of `statistic` over `replicates` resamples with replacement of
// the finite values. Coverage is near nominal for smooth statistics of some dozens of values, a
// little low for skewed ones, and meaningless for extremes. Randomness: Philox, `seed`,
// Purpose::kBootstrap, one substream per replicate. NaN ends when nothing is finite.
Interval BootstrapInterval(std::span<const double> sample, const Statistic& statistic,
                           std::uint64_t seed, double confidence = 0.95,
                           std::size_t replicates = 2000);

}  // namespace rockyard::statistics
