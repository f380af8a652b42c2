#include "statistics/clustered_rate.h"

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <vector>

#include "core/check.h"
#include "core/numbers.h"
#include "core/random.h"
#include "statistics/sample_statistics.h"
#include "truth/measurement_record.h"

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

// The fewest runs with events, and with trials without one, that can show how far events hang
// together. ClusteredRateInterval's comment states this number and kManyRuns.
constexpr double kFewRuns = 5.0;
// With more runs, their scatter shows it although a run of nothing but events may be missing.
constexpr std::size_t kManyRuns = 30;

// Returns the variance of the ratio R = sum x / sum y over that of independent trials: m var(x - R
// y) / scatter, m runs, at least 1. `scatter` is the sum of squared deviations of single values
// from the mean of all, n R (1 - R) for a rate. `seen` tells whether the runs can show how far
// events hang together; where they cannot, each run counts as one trial at most.
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

// Whether runs can show how far events hang together. `rarer` is the rate of events, or that of
// trials without one where this is smaller.
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

namespace {

// Returns how many trials share a layout, by the trials that tell theirs. Trial t of layout k = t /
// n (trial/course/layout.h) says that n is above t / (k + 1), and the last one of any layout that n
// is just above.
std::uint64_t TrialsPerLayout(std::span<const truth::Record> records,
                              std::span<const double> layouts) {
  std::uint64_t shared = 1;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!(layouts[i] >= 0.0)) continue;
    const auto layout = static_cast<std::uint64_t>(layouts[i]);
    shared = std::max(shared, records[i].trial / (layout + 1) + 1);
  }
  return shared;
}

}  // namespace

std::vector<double> LayoutsOf(const truth::RecordSchema& schema,
                              std::span<const truth::Record> records) {
  std::vector<double> layouts(records.size(), core::kNaN);
  const auto column = std::find_if(schema.begin(), schema.end(), [](const truth::ValueInfo& info) {
    return info.name == "layout";
  });
  if (column == schema.end()) return layouts;
  const auto at = static_cast<std::size_t>(column - schema.begin());
  bool untold = false;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (at < records[i].values.size()) layouts[i] = records[i].values[at];
    untold = untold || (!std::isfinite(layouts[i]) && !IsFault(records[i]));
  }
  if (!untold) return layouts;
  const std::uint64_t shared = TrialsPerLayout(records, layouts);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (std::isfinite(layouts[i]) || IsFault(records[i])) continue;
    const auto layout = records[i].trial / shared;  // a whole number
    layouts[i] = static_cast<double>(layout);
  }
  return layouts;
}

std::vector<std::size_t> DependentGroups(const truth::RecordSchema& schema,
                                         std::span<const truth::Record> records) {
  if (truth::FindColumn(schema, "layout") == nullptr) return {};
  const std::vector<double> of_trials = LayoutsOf(schema, records);
  std::map<double, std::size_t> layouts;
  std::vector<std::size_t> groups;
  for (std::size_t i = 0; i < records.size(); ++i) {
    // What a fault leaves has no layout, and is in no rate.
    const double layout =
        std::isfinite(of_trials[i]) ? of_trials[i] : -1.0 - static_cast<double>(i);
    groups.push_back(layouts.emplace(layout, layouts.size()).first->second);
  }
  if (layouts.size() == records.size()) groups.clear();
  return groups;
}

namespace {

// Returns the sums by group of the values that are finite; each value is its own group where
// `groups` is empty.
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

namespace {

struct Point {
  double x = 0.0;
  double y = 0.0;
};

// Upper (concave) hull of points in ascending x; with sign -1 the lower (convex) hull.
std::vector<Point> Hull(const std::vector<Point>& points, double sign) {
  std::vector<Point> hull;
  for (const Point& p : points) {
    while (hull.size() >= 2) {
      const Point& a = hull[hull.size() - 2];
      const Point& b = hull.back();
      // Cross product of a -> b and a -> p: its sign says to which side the hull bends at b.
      const double turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      if (sign * turn < 0.0) break;
      hull.pop_back();
    }
    hull.push_back(p);
  }
  return hull;
}

double Interpolate(const std::vector<Point>& line, double x) {
  // The two neighbours of x on a line of ascending points.
  const auto right = std::lower_bound(line.begin() + 1, line.end() - 1, x,
                                      [](const Point& p, double at) { return p.x < at; });
  const Point& a = *(right - 1);
  const Point& b = *right;
  return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

// The posterior of the rate as equally likely values.
std::vector<double> PosteriorRates(std::int64_t count, std::int64_t pool) {
  constexpr int kRates = 200;
  const boost::math::beta_distribution<double> posterior(static_cast<double>(count) + 0.5,
                                                         static_cast<double>(pool - count) + 0.5);
  std::vector<double> rates(kRates);
  for (int i = 0; i < kRates; ++i) {
    // Middles of equally likely parts of the posterior Beta(K + 1/2, N - K + 1/2).
    rates[static_cast<std::size_t>(i)] = boost::math::quantile(posterior, (i + 0.5) / kRates);
  }
  return rates;
}

struct TailCurves {
  std::vector<Point> lower;  // P(Binomial(trials, q) <= observed) over q
  std::vector<Point> upper;
};

TailCurves Curves(std::int64_t trials, std::int64_t observed) {
  constexpr int kSteps = 400;
  TailCurves curves;
  for (int i = 0; i <= kSteps; ++i) {
    const double q = static_cast<double>(i) / kSteps;
    // f(q) on a grid, from which the hulls are taken.
    const Tails tails = CountTails(BinomialLaw(trials, q), observed);
    curves.lower.push_back({q, tails.lower});
    curves.upper.push_back({q, tails.upper});
  }
  return curves;
}

double MeanOnHull(const std::vector<Point>& curve, double sign, const std::vector<double>& rates) {
  const std::vector<Point> hull = Hull(curve, sign);
  double sum = 0.0;
  // A mixture of f(q) with E q = p lies between the hulls of f at p; p itself is averaged over its
  // posterior.
  for (const double rate : rates) sum += Interpolate(hull, rate);
  return sum / static_cast<double>(rates.size());
}

CountLaw LawOf(std::int64_t trials, const LayoutEffect& effect) {
  constexpr double kAlmostNone = 1e-6;
  const double rho = std::clamp(effect.correlation, kAlmostNone, 1.0 - kAlmostNone);
  const double rate = std::clamp(effect.rate, kAlmostNone, 1.0 - kAlmostNone);
  // Two trials on one layout correlate by rho = 1 / (a + b + 1) under a beta law of the rate with
  // the mean a / (a + b).
  const double strength = (1.0 - rho) / rho;
  return BetaBinomialLaw(trials, rate * strength, (1.0 - rate) * strength);
}

}  // namespace

LayoutEffect EstimateLayoutEffect(std::span<const LayoutCount> layouts) {
  double successes = 0.0;
  double trials = 0.0;
  double squares = 0.0;
  for (const LayoutCount& layout : layouts) {
    successes += static_cast<double>(layout.successes);
    trials += static_cast<double>(layout.trials);
    squares += static_cast<double>(layout.trials) * static_cast<double>(layout.trials);
  }
  const double groups = static_cast<double>(layouts.size());
  using core::kNaN;
  if (trials == 0.0) return {kNaN, kNaN};
  const double rate = successes / trials;
  // No layout has two trials, or there is only one: nothing to tell layouts from chance by.
  if (groups < 2.0 || trials <= groups) return {rate, kNaN};
  // Fleiss 1981: with the mean squares between and within layouts and the mean size n_0 = (N - sum
  // n^2 / N) / (G - 1), rho = (MSB - MSW) / (MSB + (n_0 - 1) MSW).
  double between = 0.0;
  double within = 0.0;
  for (const LayoutCount& layout : layouts) {
    if (layout.trials == 0) continue;
    const double n = static_cast<double>(layout.trials);
    const double p = static_cast<double>(layout.successes) / n;
    between += n * (p - rate) * (p - rate);
    within += n * p * (1.0 - p);
  }
  between /= groups - 1.0;
  within /= trials - groups;
  const double size = (trials - squares / trials) / (groups - 1.0);
  const double total = between + (size - 1.0) * within;
  const double correlation = total > 0.0 ? (between - within) / total : 0.0;
  return {rate, std::clamp(correlation, 0.0, 1.0)};
}

CountLaw OneLayoutLaw(std::int64_t trials, std::span<const LayoutCount> layouts,
                      std::uint64_t seed) {
  const LayoutEffect whole = EstimateLayoutEffect(layouts);
  EXPECT(std::isfinite(whole.correlation));
  constexpr std::uint32_t kResamples = 400;
  CountLaw mean(static_cast<std::size_t>(trials) + 1, 0.0);
  std::vector<LayoutCount> resample(layouts.size());
  for (std::uint32_t b = 0; b < kResamples; ++b) {
    core::RandomStream stream({.seed = seed, .trial = 0}, core::Purpose::kBootstrap, b);
    for (LayoutCount& layout : resample) {
      const double u = stream.Uniform() * static_cast<double>(layouts.size());
      // Layouts are resampled, not trials: they are what is independent.
      layout = layouts[static_cast<std::size_t>(u)];
    }
    LayoutEffect effect = EstimateLayoutEffect(resample);
    // Layouts of one trial alone were drawn, which tell nothing of how trials hang together.
    if (!std::isfinite(effect.correlation)) effect.correlation = whole.correlation;
    const CountLaw law = LawOf(trials, effect);
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += law[k] / kResamples;
  }
  return mean;
}

Interval OneLayoutPValueBounds(std::int64_t trials, std::int64_t observed, std::int64_t count,
                               std::int64_t pool) {
  const std::vector<double> rates = PosteriorRates(count, pool);
  const TailCurves curves = Curves(trials, observed);
  const auto two_sided = [&](double sign) {
    return TwoSided({MeanOnHull(curves.lower, sign, rates), MeanOnHull(curves.upper, sign, rates)});
  };
  // Lower hulls give the smallest p-value, upper hulls the largest.
  return {two_sided(-1.0), two_sided(1.0)};
}

}  // namespace rockyard::statistics
