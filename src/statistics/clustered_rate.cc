#include "statistics/clustered_rate.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "core/check.h"
#include "statistics/moments.h"

namespace rockyard::statistics {
namespace {

double DesignEffect(std::span<const CountOfRun> runs, const CountOfRun& sum) {
  const double rate = sum.count / sum.base;
  const double binomial = sum.base * rate * (1.0 - rate);
  if (!(binomial > 0.0)) return 1.0;
  Moments residuals;
  for (const CountOfRun& run : runs) residuals.Add(run.count - rate * run.base);
  return std::max(1.0, static_cast<double>(runs.size()) * residuals.variance() / binomial);
}

// Square of the normal over Student's quantile: 1 for many runs.
double FewRuns(std::size_t runs, double confidence) {
  const double tail = 0.5 + 0.5 * confidence;
  const boost::math::students_t student(static_cast<double>(runs) - 1.0);
  const double ratio =
      boost::math::quantile(boost::math::normal(), tail) / boost::math::quantile(student, tail);
  return ratio * ratio;
}

}  // namespace

Interval ClusteredRateInterval(std::span<const CountOfRun> runs, double confidence) {
  CountOfRun sum;
  for (const CountOfRun& run : runs) {
    sum.count += run.count;
    sum.base += run.base;
  }
  EXPECT(sum.count >= 0.0 && sum.count <= sum.base);
  if (runs.size() < 2 || sum.base == 0.0) return {0.0, 1.0};
  const double trials =
      std::ceil(sum.base * FewRuns(runs.size(), confidence) / DesignEffect(runs, sum));
  const double count = trials * (sum.count / sum.base);
  const auto exact = [&](double whole) {
    return ProportionInterval(std::llround(whole), std::llround(trials), confidence,
                              IntervalMethod::kClopperPearson);
  };
  return {exact(std::floor(count)).low, exact(std::min(trials, std::ceil(count))).high};
}

}  // namespace rockyard::statistics
