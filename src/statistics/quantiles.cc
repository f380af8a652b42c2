#include "statistics/quantiles.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <limits>

#include "core/check.h"
#include "core/numbers.h"

namespace rockyard::statistics {

std::vector<double> SortedFinite(std::span<const double> values) {
  std::vector<double> sorted;
  sorted.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double x) { return std::isfinite(x); });
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

double Quantile(std::span<const double> sorted, double probability) {
  EXPECT(probability >= 0.0 && probability <= 1.0);
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  // Type 7 (Hyndman and Fan 1996): position p (n - 1), counted from 0, linear between order
  // statistics.
  const double position = probability * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double weight = position - static_cast<double>(below);
  return sorted[below] + weight * (sorted[above] - sorted[below]);
}

Interval MedianInterval(std::span<const double> sorted, double confidence) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  using core::kNaN;
  if (sorted.empty()) return {kNaN, kNaN};
  const boost::math::binomial below(static_cast<double>(sorted.size()), 0.5);
  const double tail = 0.5 * (1.0 - confidence);
  // Values that may be left out at each end: the most with P(at most so many below) <= tail.
  // Boost's quantile is that number or next to it.
  auto out = static_cast<std::size_t>(std::max(0.0, boost::math::quantile(below, tail) - 1.0));
  while (boost::math::cdf(below, static_cast<double>(out)) <= tail) ++out;
  // So few values that even the extremes do not cover the median with this confidence.
  if (out == 0) return {kNaN, kNaN};
  return {sorted[out - 1], sorted[sorted.size() - out]};
}

std::vector<EcdfPoint> Ecdf(std::span<const double> values, double confidence, BandMethod method,
                            std::optional<double> independent) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  const std::vector<double> sorted = SortedFinite(values);
  const double n = static_cast<double>(sorted.size());
  // Massart 1990: P(sup |F_n - F| > e) <= 2 e^(-2 n e^2), solved for e.
  const double half =
      std::sqrt(std::log(2.0 / (1.0 - confidence)) / (2.0 * independent.value_or(n)));
  std::vector<EcdfPoint> points;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    // One step for equal values, at the last of them.
    if (i + 1 < sorted.size() && sorted[i + 1] == sorted[i]) continue;
    const double fraction = static_cast<double>(i + 1) / n;
    const Interval band =
        method == BandMethod::kSimultaneous
            ? Interval{std::max(0.0, fraction - half), std::min(1.0, fraction + half)}
            : ProportionInterval(static_cast<std::int64_t>(i + 1),
                                 static_cast<std::int64_t>(sorted.size()), confidence,
                                 IntervalMethod::kClopperPearson);
    points.push_back({sorted[i], fraction, band});
  }
  return points;
}

}  // namespace rockyard::statistics
