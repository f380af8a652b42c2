// Kolmogorov-Smirnov tests.
#pragma once

#include <functional>
#include <span>

namespace rockyard::statistics {

struct TestResult {
  double statistic = 0.0;
  double p_value = 1.0;
};

// Tests one sample against a fully specified continuous distribution function. The p-value is exact
// to n = 1000 (Marsaglia, Tsang and Wang 2003), the limit law with Stephens' correction (1970)
// above. If parameters were fitted to the same data the p-value is too large: see
// exponential_tail.h. Values that are not finite are left out; p = 1 when nothing is left.
TestResult KolmogorovSmirnov(std::span<const double> sample,
                             const std::function<double(double)>& distribution_function);

// Tests two samples. The p-value is exact (counting lattice paths) up to 4 million pairs, the limit
// law above, and conservative with ties. p = 1 when a sample is empty.
TestResult KolmogorovSmirnov(std::span<const double> sample_1, std::span<const double> sample_2);

// Returns P(D_n >= statistic), exact.
double KolmogorovExactPValue(double statistic, int n);

// Returns the limit of P(sqrt(n) D_n >= x) for large n.
double KolmogorovLimitPValue(double x);

}  // namespace rockyard::statistics
