// Is a distribution exponential beyond an offset that the data themselves supply?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "statistics/kolmogorov.h"

namespace rockyard::statistics {

// Returns Lilliefors' statistic for the exponential law (1969): the largest distance between the
// empirical distribution of the excesses over the k-th smallest value (k = skip + 1) and an
// exponential with their mean. Offset and mean are both fitted. If values beyond the offset are
// exponential, the excesses over an order statistic are again independent and exponential with the
// same mean, so the null law depends on the number of excesses alone. `sorted` ascends. With fewer
// than 3 excesses the statistic is 0.
double ExponentialStatistic(std::span<const double> sorted, std::size_t skip = 0);

// Returns the null law of the statistic by parametric bootstrap: `replicates` samples of `excesses`
// exponential values, ascending. Randomness: Philox, Purpose::kBootstrap, one substream per
// replicate.
std::vector<double> ExponentialNullLaw(std::size_t excesses, std::size_t replicates,
                                       std::uint64_t seed);

// Returns the share of the null law that reaches `statistic`, counting the statistic itself: (1 +
// #) / (1 + replicates). It is never 0, and a valid p-value whatever the number of replicates.
double BootstrapPValue(std::span<const double> ascending_null, double statistic);

// Tests that the values beyond the (skip + 1)-th smallest are exponential.
TestResult ExponentialTailTest(std::span<const double> sample, std::uint64_t seed,
                               std::size_t skip = 0, std::size_t replicates = 9999);

}  // namespace rockyard::statistics
