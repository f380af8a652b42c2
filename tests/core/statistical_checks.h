// p-values of goodness-of-fit tests, from Boost.Math rather than from our own statistics.
#pragma once

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace rockyard::core {

// Kolmogorov's asymptotic p-value of the largest distance between the sample and `cdf`, with
// Stephens' correction for finite samples.
inline double KolmogorovP(std::vector<double> sample, const std::function<double(double)>& cdf) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double f = cdf(sample[i]);
    const auto rank = static_cast<double>(i);
    distance = std::max({distance, f - rank / n, (rank + 1.0) / n - f});
  }
  const double root = std::sqrt(n);
  const double x = (root + 0.12 + 0.11 / root) * distance;
  double p = 0.0;
  for (int k = 1; k <= 100; ++k) p += (k % 2 == 1 ? 2.0 : -2.0) * std::exp(-2.0 * k * k * x * x);
  return x < 0.2 ? 1.0 : std::clamp(p, 0.0, 1.0);
}

// Pearson's chi-square p-value; all expected counts should be 5 or more.
inline double ChiSquareP(const std::vector<double>& observed, const std::vector<double>& expected) {
  double chi_square = 0.0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const double difference = observed[i] - expected[i];
    chi_square += difference * difference / expected[i];
  }
  const auto degrees = static_cast<double>(observed.size() - 1);
  return boost::math::gamma_q(0.5 * degrees, 0.5 * chi_square);
}

}  // namespace rockyard::core
