// Statistics of sensors' noise, for tests that hold it against its law.
#pragma once

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/statistical_checks.h"

namespace rockyard::sensing {

// Chance of a false alarm of each check if its seed were drawn anew. Seeds are fixed.
constexpr double kAlpha = 1e-4;

inline double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// Two-sided p-value of a sum of squares about the mean, of so many degrees of freedom.
inline double SumOfSquaresP(double sum, double degrees, double variance) {
  const boost::math::chi_squared law(degrees);
  const double statistic = sum / variance;
  return 2.0 * std::min(cdf(law, statistic), cdf(complement(law, statistic)));
}

// The same of a normal sample about a known mean.
inline double VarianceP(const std::vector<double>& sample, double mean, double deviation) {
  double sum = 0.0;
  for (const double value : sample) sum += (value - mean) * (value - mean);
  return SumOfSquaresP(sum, static_cast<double>(sample.size()), deviation * deviation);
}

// p-value of a binomial count against a probability.
inline double CountP(double count, double trials, double probability) {
  return core::ChiSquareP({count, trials - count},
                          {trials * probability, trials * (1.0 - probability)});
}

}  // namespace rockyard::sensing
