#include "statistics/confidence_sequence.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace rockyard::statistics {
namespace {

constexpr double kPrior = 0.5;

// M_n(p) = B(a + s, b + f) / (B(a, b) p^s (1 - p)^f) is the density of the prior over that of the
// posterior at p, both beta laws: this form has no difference of large logarithms.
double LogMartingale(double successes, double failures, double rate) {
  using Beta = boost::math::beta_distribution<double>;
  const double prior = boost::math::pdf(Beta(kPrior, kPrior), rate);
  const double posterior = boost::math::pdf(Beta(kPrior + successes, kPrior + failures), rate);
  return posterior == 0.0 ? std::numeric_limits<double>::infinity()
                          : std::log(prior) - std::log(posterior);
}

// Smallest rate of the interval; the largest is its mirror image.
double LowerEnd(double successes, double failures, double alpha) {
  if (successes == 0.0) return 0.0;
  if (failures == 0.0) {
    // f = 0: M = B(a + s, b) / (B(a, b) p^s) = 1/alpha has a closed form.
    const double evidence =
        boost::math::beta(kPrior + successes, kPrior) / boost::math::beta(kPrior, kPrior);
    return std::pow(alpha * evidence, 1.0 / successes);
  }
  // log M is convex in the rate, and below 0 at the observed one.
  const auto excess = [&](double rate) {
    return LogMartingale(successes, failures, rate) + std::log(alpha);
  };
  const double trials = successes + failures;
  // A standard deviation of the rate, sqrt(s f / n^3), at a time downwards until M exceeds 1/alpha;
  // then the root lies between `low` and `high`.
  const double step = std::sqrt(successes * failures / (trials * trials * trials));
  double high = successes / trials;
  double low = std::max(high - step, 0.5 * high);
  while (excess(low) < 0.0) {
    high = low;
    low = std::max(high - step, 0.5 * high);
  }
  std::uintmax_t iterations = 100;
  const boost::math::tools::eps_tolerance<double> precise(48);
  return boost::math::tools::toms748_solve(excess, low, high, precise, iterations).first;
}

}  // namespace

double LogMixtureMartingale(std::int64_t successes, std::int64_t trials, double rate) {
  EXPECT(successes >= 0 && successes <= trials);
  EXPECT(rate > 0.0 && rate < 1.0);
  return LogMartingale(static_cast<double>(successes), static_cast<double>(trials - successes),
                       rate);
}

Interval ConfidenceSequence(std::int64_t successes, std::int64_t trials, double confidence) {
  EXPECT(successes >= 0 && successes <= trials);
  EXPECT(confidence > 0.0 && confidence < 1.0);
  if (trials == 0) return {0.0, 1.0};
  const double alpha = 1.0 - confidence;
  const auto s = static_cast<double>(successes);
  const auto f = static_cast<double>(trials - successes);
  // The prior is symmetric, so successes and failures change places.
  return {LowerEnd(s, f, alpha), 1.0 - LowerEnd(f, s, alpha)};
}

}  // namespace rockyard::statistics
