#include "statistics/sample_size.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/check.h"

namespace rockyard::statistics {
namespace {

// In double precision throughout: Boost would promote to long double, three times as slow, for
// digits that no power needs.
using Binomial = boost::math::binomial_distribution<
    double, boost::math::policies::policy<boost::math::policies::promote_double<false>>>;

// No critical count has been looked for; -1 can be the answer (FisherCritical).
constexpr std::int64_t kUnknown = -2;

// Smallest number that is enough, where enough stays enough; else one that is while the number
// before is not.
template <typename IsEnough>
std::int64_t FirstEnough(std::int64_t least, const IsEnough& is_enough) {
  std::int64_t low = least - 1;  // not enough, or none
  std::int64_t high = least;
  while (!is_enough(high)) {
    if (high >= kMaxTrials) return kMaxTrials;
    low = high;
    high = std::min(kMaxTrials, 2 * high);
  }
  while (high - low > 1) {
    const std::int64_t middle = low + (high - low) / 2;
    (is_enough(middle) ? high : low) = middle;
  }
  return high;
}

std::int64_t CountNear(double rate, std::int64_t trials) {
  return std::llround(rate * static_cast<double>(trials));
}

// Intervals are not symmetric; half of their width is what users ask for.
double HalfWidth(const Interval& interval) { return 0.5 * (interval.high - interval.low); }

double NormalQuantile(double p) { return boost::math::quantile(boost::math::normal(), p); }

// Counts that matter: all but 1e-10 of the law.
struct Window {
  std::int64_t first = 0;
  std::int64_t last = 0;
};
Window LikelyCounts(std::int64_t n, double rate) {
  const double mean = rate * static_cast<double>(n);
  const double reach = 7.0 * std::sqrt(mean * (1.0 - rate)) + 25.0;
  return {std::max<std::int64_t>(0, static_cast<std::int64_t>(mean - reach)),
          std::min(n, static_cast<std::int64_t>(mean + reach) + 1)};
}

double Probability(std::int64_t n, double rate, std::int64_t count) {
  return boost::math::pdf(Binomial(static_cast<double>(n), rate), static_cast<double>(count));
}

std::vector<double> LawOf(std::int64_t n, double rate, const Window& window) {
  std::vector<double> law;
  for (std::int64_t k = window.first; k <= window.last; ++k) law.push_back(Probability(n, rate, k));
  return law;
}

// P(count <= at); 0 below 0.
double AtMost(std::int64_t n, double rate, std::int64_t at) {
  if (at < 0) return 0.0;
  if (at >= n) return 1.0;
  return boost::math::cdf(Binomial(static_cast<double>(n), rate), static_cast<double>(at));
}

// Whether Fisher's test of two groups of n rejects, where the first has `first` of all successes.
bool FisherRejects(std::int64_t n, std::int64_t successes, std::int64_t first, double alpha) {
  const std::int64_t second = successes - first;
  return FisherExactPValue({first, n - first, second, n - second}) <= alpha;
}

// Largest number of successes of the first group, below half of all, that is rejected; less than
// what is possible where none is.
std::int64_t FisherCritical(std::int64_t n, std::int64_t successes, double alpha) {
  const std::int64_t least = std::max<std::int64_t>(0, successes - n);
  std::int64_t rejected = least - 1;
  std::int64_t kept = successes / 2;
  if (!FisherRejects(n, successes, least, alpha)) return rejected;
  rejected = least;
  while (kept - rejected > 1) {
    const std::int64_t middle = rejected + (kept - rejected) / 2;
    (FisherRejects(n, successes, middle, alpha) ? rejected : kept) = middle;
  }
  return rejected;
}

}  // namespace

std::int64_t TrialsForHalfWidth(double rate, double half_width, double confidence,
                                IntervalMethod method) {
  EXPECT(rate >= 0.0 && rate <= 1.0 && half_width > 0.0);
  // The count nearest to the rate stands for the run.
  return FirstEnough(1, [&](std::int64_t n) {
    return HalfWidth(ProportionInterval(CountNear(rate, n), n, confidence, method)) <= half_width;
  });
}

std::int64_t TrialsForStopping(double rate, double half_width, double confidence,
                               std::int64_t block) {
  EXPECT(block > 0);
  const std::int64_t n = TrialsForHalfWidth(rate, half_width, confidence, IntervalMethod::kStopped);
  // Campaigns look at the ends of blocks only.
  return (n + block - 1) / block * block;
}

std::int64_t TrialsForClaim(double bound, double confidence, std::int64_t failures) {
  EXPECT(bound > 0.0 && bound < 1.0 && failures >= 0);
  return FirstEnough(
      failures + 1, [&](std::int64_t n) { return AtMost(n, bound, failures) <= 1.0 - confidence; });
}

double ClaimChance(std::int64_t trials, double rate, std::int64_t failures) {
  EXPECT(rate >= 0.0 && rate <= 1.0);
  return AtMost(trials, rate, failures);
}

FisherTest::FisherTest(std::int64_t n, double alpha)
    : n_(n), alpha_(alpha), critical_(static_cast<std::size_t>(2 * n + 1), kUnknown) {
  EXPECT(n > 0 && alpha > 0.0 && alpha < 1.0);
}

std::int64_t FisherTest::Critical(std::int64_t successes) {
  std::int64_t& critical = critical_[static_cast<std::size_t>(successes)];
  // Looked for once for each number of successes.
  if (critical == kUnknown) critical = FisherCritical(n_, successes, alpha_);
  return critical;
}

double FisherTest::Power(const RatePair& rates) {
  const Window first = LikelyCounts(n_, rates.first);
  const Window second = LikelyCounts(n_, rates.second);
  const std::vector<double> first_law = LawOf(n_, rates.first, first);
  const std::vector<double> second_law = LawOf(n_, rates.second, second);
  double power = 0.0;
  for (std::int64_t all = first.first + second.first; all <= first.last + second.last; ++all) {
    const std::int64_t critical = Critical(all);
    const std::int64_t from = std::max(first.first, all - second.last);
    const std::int64_t to = std::min(first.last, all - second.first);
    for (std::int64_t k = from; k <= to; ++k) {
      // The test is symmetric in groups of one size: either group's count may be the small one.
      if (k > critical && all - k > critical) continue;
      power += first_law[static_cast<std::size_t>(k - first.first)] *
               second_law[static_cast<std::size_t>(all - k - second.first)];
    }
  }
  return power;
}

double FisherPower(std::int64_t n, const RatePair& rates, double alpha) {
  return FisherTest(n, alpha).Power(rates);
}

std::int64_t TrialsForFisherFormula(const RatePair& rates, double alpha, double power) {
  const double difference = std::abs(rates.second - rates.first);
  EXPECT(difference > 0.0);
  const double mean = 0.5 * (rates.first + rates.second);
  // Casagrande, Pike and Smith 1978: with A = (z_a sqrt(2 p (1 - p)) + z_b sqrt(p_1 q_1 + p_2
  // q_2))^2,
  //   n = A (1 + sqrt(1 + 4 d/A))^2 / (4 d^2).
  const double root = NormalQuantile(1.0 - 0.5 * alpha) * std::sqrt(2.0 * mean * (1.0 - mean)) +
                      NormalQuantile(power) * std::sqrt(rates.first * (1.0 - rates.first) +
                                                        rates.second * (1.0 - rates.second));
  const double corrected = 1.0 + std::sqrt(1.0 + 4.0 * difference / (root * root));
  const double n = 0.25 * root * root / (difference * difference) * corrected * corrected;
  return n >= static_cast<double>(kMaxTrials) ? kMaxTrials
                                              : static_cast<std::int64_t>(std::ceil(n));
}

std::int64_t TrialsForFisher(const RatePair& rates, double alpha, double power) {
  const std::int64_t formula = TrialsForFisherFormula(rates, alpha, power);
  if (formula > kMaxExactFisher) return formula;
  return FirstEnough(1, [&](std::int64_t n) { return FisherPower(n, rates, alpha) >= power; });
}

double McNemarPower(std::int64_t n, const RatePair& discordant, double alpha) {
  const double rate = discordant.first + discordant.second;
  EXPECT(rate > 0.0 && rate <= 1.0);
  const Window likely = LikelyCounts(n, rate);
  double power = 0.0;
  std::int64_t critical = -1;  // grows with the discordant pairs
  for (std::int64_t d = likely.first; d <= likely.last; ++d) {
    // Largest count of the rarer kind that the test still rejects among d pairs.
    while (2 * (critical + 1) < d && McNemarExactPValue(critical + 1, d - critical - 1) <= alpha) {
      ++critical;
    }
    if (critical < 0) continue;
    // Given d discordant pairs, the first kind is Binomial(d, share); both tails reject.
    const double share = discordant.first / rate;
    power +=
        Probability(n, rate, d) * (AtMost(d, share, critical) + AtMost(d, 1.0 - share, critical));
  }
  return power;
}

std::int64_t TrialsForMcNemar(const RatePair& discordant, double alpha, double power) {
  EXPECT(discordant.first != discordant.second);
  return FirstEnough(1,
                     [&](std::int64_t n) { return McNemarPower(n, discordant, alpha) >= power; });
}

double EquivalencePower(double margin, double standard_error, double degrees_of_freedom,
                        double alpha) {
  EXPECT(margin > 0.0 && degrees_of_freedom > 0.0);
  if (standard_error == 0.0) return 1.0;
  const boost::math::students_t law(degrees_of_freedom);
  // At a true difference of 0 both tests reject where |T| < margin/error - t_(1 - alpha).
  const double reach = margin / standard_error - boost::math::quantile(law, 1.0 - alpha);
  return std::max(0.0, 2.0 * boost::math::cdf(law, reach) - 1.0);
}

std::int64_t TrialsForEquivalence(double margin, double deviation, double alpha, double power,
                                  Pairing pairing) {
  EXPECT(margin > 0.0 && deviation >= 0.0);
  return FirstEnough(2, [&](std::int64_t trials) {
    const auto n = static_cast<double>(trials);
    const bool paired = pairing == Pairing::kPaired;
    // Standard error of a mean of n differences, or of the difference of two means of n.
    const double error = deviation * std::sqrt((paired ? 1.0 : 2.0) / n);
    return EquivalencePower(margin, error, paired ? n - 1.0 : 2.0 * n - 2.0, alpha) >= power;
  });
}

}  // namespace rockyard::statistics
