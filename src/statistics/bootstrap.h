// Percentile bootstrap intervals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// A statistic of a sample in ascending order.
using Statistic = std::function<double(std::span<const double>)>;

// Returns the percentile interval (Efron 1979) of `statistic` over `replicates` resamples with
// replacement of the finite values. Coverage is near nominal for smooth statistics of some dozens
// of values, a little low for skewed ones, and meaningless for extremes. Randomness: Philox,
// `seed`, Purpose::kBootstrap, one substream per replicate. The ends are NaN when nothing is
// finite.
Interval BootstrapInterval(std::span<const double> sample, const Statistic& statistic,
                           std::uint64_t seed, double confidence = kConfidence,
                           std::size_t replicates = 2000);

// Returns what BootstrapInterval gives for the mean (of MomentsOf) of each sample, bit for bit:
// samples with as many finite values are resampled alike there too, so that here they share the
// draws, and several resamples are summed at once, and nothing is sorted. Cost: about 1 ns per
// finite value and replicate. Memory: a copy of the samples, and 100 bytes for each value of the
// longest.
std::vector<Interval> BootstrapMeanIntervals(std::span<const std::vector<double>> samples,
                                             std::uint64_t seed, double confidence = kConfidence,
                                             std::size_t replicates = 2000);

}  // namespace rockyard::statistics
