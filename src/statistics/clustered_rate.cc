#include "statistics/clustered_rate.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "core/check.h"
#include "statistics/sample_statistics.h"

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

// Runs with events, and with what is none, that can show how far these hang together.
constexpr double kFewRuns = 5.0;
// With more runs, their scatter shows it although a run of nothing but events may be missing.
constexpr std::size_t kManyRuns = 30;

// Variance of the ratio R = sum x / sum y over the one of independent trials: m var(x - R y) /
// scatter, m runs, at least 1. `scatter` is the sum of squared deviations of single values from the
// mean of all, n R (1 - R) for a rate. `seen`: whether the runs can show how far
// events hang together.
double DesignEffect(std::span<const CountOfRun> runs, const CountOfRun& sum, double scatter,
                    bool seen) {
  const double one_per_run = std::max(1.0, sum.base / static_cast<double>(runs.size()));
  if (!(scatter > 1e-12 * sum.base)) return one_per_run;
  const double mean = sum.count / sum.base;
  Moments residuals;
  for (const CountOfRun& run : runs) residuals.Add(run.count - mean * run.base);
  const double effect = static_cast<double>(runs.size()) * residuals.variance() / scatter;
  return std::max(seen ? 1.0 : one_per_run, effect);
}

// Whether runs can show how far events hang together, of which `rarer` is the share of those, or of
// the others.
bool ShowDependence(std::span<const CountOfRun> runs, double rarer) {
  const auto with = std::count_if(runs.begin(), runs.end(),
                                  [](const CountOfRun& run) { return run.count > 0.0; });
  const auto without = std::count_if(runs.begin(), runs.end(),
                                     [](const CountOfRun& run) { return run.count < run.base; });
  const auto all = static_cast<double>(runs.size());
  const bool enough = runs.size() > kManyRuns || all * rarer >= kFewRuns;
  return enough && static_cast<double>(std::min(with, without)) >= kFewRuns;
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
  const CountOfRun sum = SumOf(runs);
  EXPECT(sum.count >= 0.0 && sum.count <= sum.base);
  if (runs.size() < 2 || sum.base == 0.0) return {0.0, 1.0};
  const double rate = sum.count / sum.base;
  const double effect = DesignEffect(runs, sum, sum.base * rate * (1.0 - rate),
                                     ShowDependence(runs, std::min(rate, 1.0 - rate)));
  // Effective numbers: n / design effect (z/t)^2, and as many successes at the same rate.
  const double trials = std::ceil(sum.base * FewRuns(runs.size(), confidence) / effect);
  const double count = trials * rate;
  const auto exact = [&](double whole) {
    return ProportionInterval(std::llround(whole), std::llround(trials), confidence,
                              IntervalMethod::kClopperPearson);
  };
  return {exact(std::floor(count)).low, exact(std::min(trials, std::ceil(count))).high};
}

Proportion RateOfRuns(std::span<const CountOfRun> runs, bool independent, double confidence,
                      IntervalMethod method) {
  const CountOfRun sum = SumOf(runs);
  Proportion rate =
      MakeProportion(std::llround(sum.count), std::llround(sum.base), confidence, method);
  const bool single =
      std::all_of(runs.begin(), runs.end(), [](const CountOfRun& run) { return run.base <= 1.0; });
  if (!independent && !single) {
    rate.interval = ClusteredRateInterval(runs, confidence);
    rate.method = IntervalMethod::kClustered;
  }
  return rate;
}

std::vector<std::size_t> DependentGroups(const truth::RecordSchema& schema,
                                         std::span<const truth::Record> records) {
  const auto column = std::find_if(schema.begin(), schema.end(), [](const truth::ValueInfo& info) {
    return info.name == "layout";
  });
  if (column == schema.end()) return {};
  const auto at = static_cast<std::size_t>(column - schema.begin());
  std::map<double, std::size_t> layouts;
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < records.size(); ++i) {
    // What a fault leaves has no layout, and is in no rate.
    const bool told = at < records[i].values.size() && std::isfinite(records[i].values[at]);
    const double layout = told ? records[i].values[at] : -1.0 - static_cast<double>(i);
    groups.push_back(layouts.emplace(layout, layouts.size()).first->second);
  }
  if (layouts.size() == records.size()) groups.clear();
  return groups;
}

namespace {

// Sums by group of the values that are finite; each is its own group where `groups` is empty.
std::vector<CountOfRun> SumsByGroup(std::span<const double> values,
                                    std::span<const std::size_t> groups) {
  EXPECT(groups.empty() || groups.size() == values.size());
  std::vector<CountOfRun> sums(
      groups.empty() ? values.size() : *std::max_element(groups.begin(), groups.end()) + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    CountOfRun& sum = sums[groups.empty() ? i : groups[i]];
    sum.count += values[i];
    sum.base += 1.0;
  }
  std::erase_if(sums, [](const CountOfRun& sum) { return sum.base == 0.0; });
  return sums;
}

}  // namespace

std::vector<double> OnesWhere(std::span<const truth::Record> records,
                              bool (*succeeded)(truth::TrialOutcome)) {
  return OnesWhere(records, [&](const truth::Record& record) { return succeeded(record.outcome); });
}

std::vector<double> OnesWhere(std::span<const truth::Record> records,
                              const std::function<bool(const truth::Record&)>& holds) {
  std::vector<double> values;
  values.reserve(records.size());
  for (const truth::Record& record : records) {
    const double value = holds(record) ? 1.0 : 0.0;
    values.push_back(IsFault(record) ? std::numeric_limits<double>::quiet_NaN() : value);
  }
  return values;
}

Proportion RateOfTrials(std::span<const double> values, std::span<const std::size_t> groups,
                        double confidence, IntervalMethod method) {
  return RateOfRuns(SumsByGroup(values, groups), false, confidence, method);
}

MeanEstimate MeanOfTrials(std::span<const double> values, std::span<const std::size_t> groups,
                          std::int64_t fewest, double confidence) {
  MeanEstimate estimate = EstimateMean(SortedFinite(values), fewest, confidence);
  if (groups.empty() || estimate.lack != MeanLack::kNone) return estimate;
  const std::vector<CountOfRun> sums = SumsByGroup(values, groups);
  const CountOfRun sum = SumOf(sums);
  const double mean = sum.count / sum.base;
  std::vector<double> shares;
  shares.reserve(sums.size());
  for (const CountOfRun& group : sums) {
    shares.push_back(mean + (group.count - mean * group.base) * static_cast<double>(sums.size()) /
                                sum.base);
  }
  const MeanEstimate of_groups = EstimateMean(SortedFinite(shares), fewest, confidence);
  estimate.interval = of_groups.interval;
  estimate.lack = of_groups.lack;
  estimate.needs = of_groups.needs;
  return estimate;
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
  const double effect = DesignEffect(met, sum, scatter, true);
  const double share = FewRuns(met.size(), confidence) / effect;
  return {.n = share * sum.base, .sum = share * sum.count, .squares = share * squares_};
}

}  // namespace rockyard::statistics
