#include "statistics/clustered_rate.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>

#include "core/check.h"
#include "statistics/moments.h"

namespace rockyard::statistics {
namespace {

CountOfRun SumOf(std::span<const CountOfRun> runs) {
  CountOfRun sum;
  for (const CountOfRun& run : runs) {
    sum.count += run.count;
    sum.base += run.base;
  }
  return sum;
}

// Variance of the ratio R = sum x / sum y over the one of independent trials: m var(x - R y) /
// scatter, m runs, at least 1. `scatter` is the sum of squared deviations of single values from the
// mean of all, n R (1 - R) for a rate.
double DesignEffect(std::span<const CountOfRun> runs, const CountOfRun& sum, double scatter,
                    WithoutScatter unseen) {
  if (!(scatter > 1e-12 * sum.base)) {
    // No scatter at all: dependence cannot be seen and is assumed; base / runs makes each run count
    // as one trial.
    return unseen == WithoutScatter::kIndependent ? 1.0
                                                  : sum.base / static_cast<double>(runs.size());
  }
  const double mean = sum.count / sum.base;
  Moments residuals;
  for (const CountOfRun& run : runs) residuals.Add(run.count - mean * run.base);
  return std::max(1.0, static_cast<double>(runs.size()) * residuals.variance() / scatter);
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

Interval ClusteredRateInterval(std::span<const CountOfRun> runs, double confidence,
                               WithoutScatter unseen) {
  const CountOfRun sum = SumOf(runs);
  EXPECT(sum.count >= 0.0 && sum.count <= sum.base);
  if (runs.size() < 2 || sum.base == 0.0) return {0.0, 1.0};
  const double rate = sum.count / sum.base;
  const double effect = DesignEffect(runs, sum, sum.base * rate * (1.0 - rate), unseen);
  // Effective numbers: n / design effect (z/t)^2, and as many successes at the same rate.
  const double trials = std::ceil(sum.base * FewRuns(runs.size(), confidence) / effect);
  const double count = trials * rate;
  const auto exact = [&](double whole) {
    return ProportionInterval(std::llround(whole), std::llround(trials), confidence,
                              IntervalMethod::kClopperPearson);
  };
  return {exact(std::floor(count)).low, exact(std::min(trials, std::ceil(count))).high};
}

void ClusteredValues::Add(std::size_t cluster, double value) {
  if (cluster >= clusters_.size()) clusters_.resize(cluster + 1);
  clusters_[cluster].count += value;
  clusters_[cluster].base += 1.0;
  squares_ += value * value;
}

SignedValues ClusteredValues::Effective(double confidence) const {
  std::vector<CountOfRun> met;
  std::copy_if(clusters_.begin(), clusters_.end(), std::back_inserter(met),
               [](const CountOfRun& cluster) { return cluster.base > 0.0; });
  if (met.size() < 2) return {};
  const CountOfRun sum = SumOf(met);
  // sum (x - mean)^2 = sum x^2 - (sum x)^2 / n.
  const double scatter = squares_ - sum.count * sum.count / sum.base;
  const double effect = DesignEffect(met, sum, scatter, WithoutScatter::kOnePerRun);
  const double share = FewRuns(met.size(), confidence) / effect;
  return {.n = share * sum.base, .sum = share * sum.count, .squares = share * squares_};
}

}  // namespace rockyard::statistics
