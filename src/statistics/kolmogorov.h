// Kolmogorov-Smirnov tests, and Lilliefors' test of exponential tails, for statistics of one column
// in the comparison with published values. No record depends on them, but the verdict on an
// exponential tail, and so an exit code, depends on ExponentialNullLaw and its draws; the others
// are shown and not judged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rockyard::statistics {

struct TestResult {
  double statistic = 0.0;
  double p_value = 1.0;
};

// Tests one sample against a fully specified continuous distribution function. The p-value is exact
// to n = 1000 (Marsaglia, Tsang and Wang 2003), the limit law with Stephens' correction (1970)
// above. If parameters were fitted to the same data the p-value is too large: see
// ExponentialTailTest. Values that are not finite are left out; p = 1 when nothing is left.
TestResult KolmogorovSmirnov(std::span<const double> sample,
                             const std::function<double(double)>& distribution_function);

// Tests two samples. The p-value is exact (counting lattice paths) up to 4 million pairs, the limit
// law above, and conservative with ties. p = 1 when a sample is empty.
TestResult KolmogorovSmirnov(std::span<const double> sample_1, std::span<const double> sample_2);

// Returns P(D_n >= statistic), exact.
double KolmogorovExactPValue(double statistic, int n);

// Returns the limit of P(sqrt(n) D_n >= x) for large n.
double KolmogorovLimitPValue(double x);

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
