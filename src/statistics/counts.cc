#include "statistics/counts.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "core/check.h"

namespace rockyard::statistics {
namespace {

double LogBeta(double a, double b) {
  return boost::math::lgamma(a) + boost::math::lgamma(b) - boost::math::lgamma(a + b);
}

// C(n, k) = 1 / ((n + 1) B(n - k + 1, k + 1)).
double LogChoose(double n, double k) { return -std::log(n + 1.0) - LogBeta(n - k + 1.0, k + 1.0); }

}  // namespace

Interval PoissonInterval(std::int64_t count, double confidence) {
  EXPECT(count >= 0 && confidence > 0.0 && confidence < 1.0);
  const double tail = 0.5 * (1.0 - confidence);
  const auto seen = static_cast<double>(count);
  // P(N >= n; mean) is the regularized lower incomplete gamma function P(n, mean), P(N <= n; mean)
  // the upper one Q(n + 1, mean).
  const double low = count == 0 ? 0.0 : boost::math::gamma_p_inv(seen, tail);
  return {low, boost::math::gamma_q_inv(seen + 1.0, tail)};
}

CountLaw BinomialLaw(std::int64_t trials, double rate) {
  EXPECT(trials >= 0 && rate >= 0.0 && rate <= 1.0);
  const boost::math::binomial law(static_cast<double>(trials), rate);
  CountLaw probabilities(static_cast<std::size_t>(trials) + 1);
  for (std::size_t k = 0; k < probabilities.size(); ++k) {
    probabilities[k] = boost::math::pdf(law, static_cast<double>(k));
  }
  return probabilities;
}

CountLaw BetaBinomialLaw(std::int64_t trials, double a, double b) {
  EXPECT(trials >= 0 && a > 0.0 && b > 0.0);
  const double n = static_cast<double>(trials);
  CountLaw probabilities(static_cast<std::size_t>(trials) + 1);
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    const double k = static_cast<double>(i);
    // P(k) = C(n, k) B(k + a, n - k + b) / B(a, b).
    probabilities[i] = std::exp(LogChoose(n, k) + LogBeta(k + a, n - k + b) - LogBeta(a, b));
  }
  return probabilities;
}

CountLaw PredictiveCountLaw(std::int64_t trials, std::int64_t count, std::int64_t pool) {
  EXPECT(count >= 0 && count <= pool);
  // Posterior of a rate after K of N under Jeffreys' prior: Beta(K + 1/2, N - K + 1/2).
  constexpr double kJeffreys = 0.5;
  return BetaBinomialLaw(trials, static_cast<double>(count) + kJeffreys,
                         static_cast<double>(pool - count) + kJeffreys);
}

std::int64_t CountQuantile(const CountLaw& law, double probability) {
  constexpr double kRounding = 1e-12;
  double sum = 0.0;
  for (std::size_t k = 0; k < law.size(); ++k) {
    sum += law[k];
    if (sum >= probability - kRounding) return static_cast<std::int64_t>(k);
  }
  return static_cast<std::int64_t>(law.size()) - 1;
}

Tails CountTails(const CountLaw& law, std::int64_t observed) {
  EXPECT(observed >= 0 && observed < static_cast<std::int64_t>(law.size()));
  Tails tails{0.0, 0.0};
  for (std::size_t k = 0; k < law.size(); ++k) {
    // The observed count belongs to both tails.
    if (static_cast<std::int64_t>(k) <= observed) tails.lower += law[k];
    if (static_cast<std::int64_t>(k) >= observed) tails.upper += law[k];
  }
  return {std::min(1.0, tails.lower), std::min(1.0, tails.upper)};
}

double TwoSided(const Tails& tails) {
  return std::min(1.0, 2.0 * std::min(tails.lower, tails.upper));
}

double CountPower(const CountLaw& null, const CountLaw& truth, double level) {
  EXPECT(null.size() == truth.size());
  double power = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    // The counts that the test rejects, weighed by their probability under `truth`.
    if (TwoSided(CountTails(null, static_cast<std::int64_t>(k))) <= level) power += truth[k];
  }
  return std::min(1.0, power);
}

}  // namespace rockyard::statistics
