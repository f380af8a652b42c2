#include "statistics/proportions.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/check.h"
#include "core/random.h"

namespace rockyard::statistics {

namespace {

// Wilson 1927: the rates p whose score (k/n - p) / sqrt(p (1 - p) / n) is within +-z,
//   (k/n + z^2/2n +- z sqrt(k/n (1 - k/n)/n + z^2/4n^2)) / (1 + z^2/n).
// The ends at no and at all successes are exact, whatever rounding does.
Interval Wilson(double count, double trials, double confidence) {
  const double z = boost::math::quantile(boost::math::normal(), 0.5 + 0.5 * confidence);
  const double rate = count / trials;
  const double scale = 1.0 / (1.0 + z * z / trials);
  const double centre = scale * (rate + z * z / (2.0 * trials));
  const double half =
      scale * z * std::sqrt(rate * (1.0 - rate) / trials + z * z / (4.0 * trials * trials));
  return {count == 0.0 ? 0.0 : std::max(0.0, centre - half),
          count == trials ? 1.0 : std::min(1.0, centre + half)};
}

// Share of the chance to miss at which the interval is taken where the half-width ends the trials
// (ProportionInterval, whose comment states it). Must stay: campaigns stop by this interval, and a
// later session decides again from the stored trials (batch/work_plan.h), so that another share
// would end the cells of stored campaigns elsewhere.
constexpr double kStoppedShare = 0.8;

// Clopper and Pearson 1934: ends at which a tail of the binomial law is (1 - confidence)/2, as
// quantiles of beta laws: B(tail; k, n - k + 1) and B(1 - tail; k + 1, n - k).
Interval ClopperPearson(double count, double trials, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  const auto beta_quantile = [](double a, double b, double p) {
    return boost::math::quantile(boost::math::beta_distribution<double>(a, b), p);
  };
  return {count == 0.0 ? 0.0 : beta_quantile(count, trials - count + 1.0, tail),
          count == trials ? 1.0 : beta_quantile(count + 1.0, trials - count, 1.0 - tail)};
}

// Probabilities of the number of successes in group 1, all margins given, over the largest of them.
struct HypergeometricWeights {
  std::int64_t lowest = 0;
  std::vector<double> weights;

  std::int64_t highest() const { return lowest + static_cast<std::int64_t>(weights.size()) - 1; }
  double& At(std::int64_t x) { return weights[static_cast<std::size_t>(x - lowest)]; }
  double At(std::int64_t x) const { return weights[static_cast<std::size_t>(x - lowest)]; }
};

// Makes the weights by the ratio of neighbours outwards from the mode, where nothing can overflow;
// what underflows is too small to matter. A closed form of each would cost a factorization of the
// factorials.
HypergeometricWeights MakeWeights(std::int64_t group_1, std::int64_t group_2,
                                  std::int64_t successes) {
  HypergeometricWeights law;
  law.lowest = std::max<std::int64_t>(0, successes - group_2);
  const std::int64_t highest = std::min(successes, group_1);
  law.weights.assign(static_cast<std::size_t>(highest - law.lowest + 1), 1.0);
  const double a = static_cast<double>(group_1);
  const double b = static_cast<double>(group_2);
  const double k = static_cast<double>(successes);
  // P(x) ~ C(a, x) C(b, k - x), so P(x + 1) / P(x) = (k - x)(a - x) / ((x + 1)(b - k + x + 1)).
  const auto ratio = [&](std::int64_t at) {
    const double x = static_cast<double>(at);
    return (k - x) * (a - x) / ((x + 1.0) * (b - k + x + 1.0));
  };
  // The mode of a hypergeometric law, rounded down.
  const auto near_mode = static_cast<std::int64_t>((k + 1.0) * (a + 1.0) / (a + b + 2.0));
  const std::int64_t mode = std::clamp(near_mode, law.lowest, highest);
  for (std::int64_t x = mode; x < highest; ++x) law.At(x + 1) = law.At(x) * ratio(x);
  for (std::int64_t x = mode; x > law.lowest; --x) law.At(x - 1) = law.At(x) / ratio(x - 1);
  return law;
}

}  // namespace

Interval ProportionInterval(std::int64_t count, std::int64_t trials, double confidence,
                            IntervalMethod method) {
  EXPECT(count >= 0 && count <= trials);
  EXPECT(confidence > 0.0 && confidence < 1.0);
  EXPECT(method != IntervalMethod::kClustered);
  if (trials == 0) return {0.0, 1.0};
  const double k = static_cast<double>(count);
  const double n = static_cast<double>(trials);
  switch (method) {
    case IntervalMethod::kWilson:
      return Wilson(k, n, confidence);
    case IntervalMethod::kClopperPearson:
      return ClopperPearson(k, n, confidence);
    case IntervalMethod::kStopped:
    case IntervalMethod::kClustered:
      break;
  }
  return ClopperPearson(k, n, 1.0 - kStoppedShare * (1.0 - confidence));
}

Interval ExactInterval(double count, double trials, double confidence) {
  EXPECT(count >= 0.0 && count <= trials && confidence > 0.0 && confidence < 1.0);
  return ClopperPearson(count, trials, confidence);
}

std::string_view MethodName(IntervalMethod method) {
  // Must stay in the order of IntervalMethod.
  constexpr std::array<std::string_view, 4> kNames{"wilson", "clopper_pearson",
                                                   "clopper_pearson_stopped", "clustered"};
  return kNames[static_cast<std::size_t>(method)];
}

IntervalMethod RateMethod(std::int64_t count, std::int64_t trials, IntervalMethod method) {
  constexpr std::int64_t kFew = 5;
  const bool few = std::min(count, trials - count) < kFew;
  return few && method == IntervalMethod::kWilson ? IntervalMethod::kClopperPearson : method;
}

Proportion MakeProportion(std::int64_t count, std::int64_t trials, double confidence,
                          IntervalMethod method) {
  const double rate = trials == 0 ? std::numeric_limits<double>::quiet_NaN()
                                  : static_cast<double>(count) / static_cast<double>(trials);
  const IntervalMethod chosen = RateMethod(count, trials, method);
  return {count, trials, rate, ProportionInterval(count, trials, confidence, chosen), chosen};
}

Interval DifferenceInterval(const Proportion& first, const Proportion& second, double confidence) {
  if (first.trials == 0 || second.trials == 0) return {-1.0, 1.0};
  const auto ends = [&](const Proportion& rate) {
    return rate.method == IntervalMethod::kClustered
               ? rate.interval
               : ProportionInterval(rate.count, rate.trials, confidence);
  };
  const Interval a = ends(first);
  const Interval b = ends(second);
  const double difference = second.rate - first.rate;
  // Newcombe 1998, method 10: d - sqrt((p_2 - l_2)^2 + (u_1 - p_1)^2) .. d + sqrt((u_2 - p_2)^2 +
  // (p_1 - l_1)^2) with the Wilson ends l, u.
  return {difference - std::hypot(second.rate - b.low, a.high - first.rate),
          difference + std::hypot(b.high - second.rate, first.rate - a.low)};
}

double FisherExactPValue(const ContingencyTable& table) {
  EXPECT(table.success_1 >= 0 && table.failure_1 >= 0 && table.success_2 >= 0 &&
         table.failure_2 >= 0);
  const std::int64_t group_1 = table.success_1 + table.failure_1;
  const std::int64_t group_2 = table.success_2 + table.failure_2;
  const std::int64_t successes = table.success_1 + table.success_2;
  const HypergeometricWeights law = MakeWeights(group_1, group_2, successes);
  constexpr double kTieTolerance = 1e-7;
  const double limit = law.At(table.success_1) * (1.0 + kTieTolerance);
  double all = 0.0;
  double extreme = 0.0;
  for (std::int64_t x = law.lowest; x <= law.highest(); ++x) {
    const double weight = law.At(x);
    all += weight;
    // All tables no more probable than the observed one, with room for rounding.
    if (weight <= limit) extreme += weight;
  }
  return extreme / all;
}

double McNemarExactPValue(std::int64_t only_first, std::int64_t only_second) {
  EXPECT(only_first >= 0 && only_second >= 0);
  const std::int64_t discordant = only_first + only_second;
  if (discordant == 0) return 1.0;
  // Under the null a discordant pair is a fair coin: p = 2 P(Binomial(d, 1/2) <= min), at most 1.
  const boost::math::binomial law(static_cast<double>(discordant), 0.5);
  return std::min(
      1.0, 2.0 * boost::math::cdf(law, static_cast<double>(std::min(only_first, only_second))));
}

void PairedCounts::Add(bool first, bool second) {
  if (first) {
    ++(second ? both : only_first);
  } else {
    ++(second ? only_second : neither);
  }
}

Interval AgrestiMinInterval(const SignedValues& values, double confidence) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  if (!(values.n > 0.0)) return {-1.0, 1.0};
  // Agresti and Min 2005: half a pair more in each of four cells adds 2 to n, 0 to the sum and 1 to
  // the squares; then the normal interval of the mean.
  const double n = values.n + 2.0;
  const double centre = values.sum / n;
  const double variance = (values.squares + 1.0) / n - centre * centre;
  const double half =
      core::NormalQuantile(0.5 + 0.5 * confidence) * std::sqrt(std::max(0.0, variance) / n);
  return {std::max(-1.0, centre - half), std::min(1.0, centre + half)};
}

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
