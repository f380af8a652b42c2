#include "statistics/proportions.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/hypergeometric.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>

#include "core/check.h"

namespace rockyard::statistics {
namespace {

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

Interval ClopperPearson(double count, double trials, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  const auto beta_quantile = [](double a, double b, double p) {
    return boost::math::quantile(boost::math::beta_distribution<double>(a, b), p);
  };
  return {count == 0.0 ? 0.0 : beta_quantile(count, trials - count + 1.0, tail),
          count == trials ? 1.0 : beta_quantile(count + 1.0, trials - count, 1.0 - tail)};
}

}  // namespace

Interval ProportionInterval(std::int64_t count, std::int64_t trials, double confidence,
                            IntervalMethod method) {
  EXPECT(count >= 0 && count <= trials);
  EXPECT(confidence > 0.0 && confidence < 1.0);
  if (trials == 0) return {0.0, 1.0};
  const double k = static_cast<double>(count);
  const double n = static_cast<double>(trials);
  return method == IntervalMethod::kWilson ? Wilson(k, n, confidence)
                                           : ClopperPearson(k, n, confidence);
}

Proportion MakeProportion(std::int64_t count, std::int64_t trials, double confidence,
                          IntervalMethod method) {
  const double rate = trials == 0 ? std::numeric_limits<double>::quiet_NaN()
                                  : static_cast<double>(count) / static_cast<double>(trials);
  return {count, trials, rate, ProportionInterval(count, trials, confidence, method)};
}

double FisherExactPValue(const ContingencyTable& table, Alternative alternative) {
  EXPECT(table.success_1 >= 0 && table.failure_1 >= 0 && table.success_2 >= 0 &&
         table.failure_2 >= 0);
  const std::int64_t successes = table.success_1 + table.success_2;
  const std::int64_t group_1 = table.success_1 + table.failure_1;
  const std::int64_t total = group_1 + table.success_2 + table.failure_2;
  if (total == 0) return 1.0;
  const boost::math::hypergeometric law(static_cast<unsigned>(successes),
                                        static_cast<unsigned>(group_1),
                                        static_cast<unsigned>(total));
  const std::int64_t lowest = std::max<std::int64_t>(0, successes + group_1 - total);
  const std::int64_t highest = std::min(successes, group_1);
  constexpr double kTieTolerance = 1e-7;
  const double limit =
      boost::math::pdf(law, static_cast<unsigned>(table.success_1)) * (1.0 + kTieTolerance);
  double p_value = 0.0;
  for (std::int64_t x = lowest; x <= highest; ++x) {
    const double probability = boost::math::pdf(law, static_cast<unsigned>(x));
    const bool as_extreme = alternative == Alternative::kLess      ? x <= table.success_1
                            : alternative == Alternative::kGreater ? x >= table.success_1
                                                                   : probability <= limit;
    if (as_extreme) p_value += probability;
  }
  return std::min(1.0, p_value);
}

double McNemarExactPValue(std::int64_t only_first, std::int64_t only_second) {
  EXPECT(only_first >= 0 && only_second >= 0);
  const std::int64_t discordant = only_first + only_second;
  if (discordant == 0) return 1.0;
  const boost::math::binomial law(static_cast<double>(discordant), 0.5);
  return std::min(
      1.0, 2.0 * boost::math::cdf(law, static_cast<double>(std::min(only_first, only_second))));
}

}  // namespace rockyard::statistics
