// Rates and means of trials that hang together, and of runs that all met the same rocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "statistics/proportions.h"
#include "statistics/sample_statistics.h"
#include "truth/record.h"

namespace rockyard::statistics {

// A count of one run and what it is counted of.
struct CountOfRun {
  double count = 0.0;
  double base = 0.0;
};

// Returns the interval of the ratio of both sums, where runs are independent and what happens
// within one is not (several hazards of one drive, trials on one layout). It is Clopper and
// Pearson's of effective numbers (Korn and Graubard 1998, Survey Methodology 24, pp. 193-201):
// counts and base are divided by the design effect, which is
//   max(1, runs Var(x - R y) / (n R (1 - R))),  x and y of the runs, R and n of all,
// and by the square of Student's over the normal quantile, for the few runs behind it. Fractions
// are rounded outwards. Fewer than five runs with an event, or with what is none, cannot show how
// far these hang together, nor can up to thirty runs that would show fewer than five if each were
// one trial, as a run of nothing but events may well be missing: each run then says as much as one
// trial. So it holds the rate in 93 % of samples and more (8 to 60 runs of 5 to 50 trials, rates of
// 3 to 90 %; tests/statistics/clustered_test.cc).
// Limits: one run, or no base, says nothing: [0, 1]. 0 <= count <= base. Cost: linear.
Interval ClusteredRateInterval(std::span<const CountOfRun> runs, double confidence);

// The rate with its interval: that of independent trials, by RateMethod, where no run has more than
// one (or all are, as `independent` says), else the one above.
Proportion RateOfRuns(std::span<const CountOfRun> runs, bool independent = false,
                      double confidence = kConfidence,
                      IntervalMethod method = IntervalMethod::kWilson);

// One number for each group of trials that hang together, from 0: those on one layout of rocks (the
// column "layout"; course.trials_per_layout). Empty where all trials are independent: no two share
// a layout, or no column tells. Every rate, mean and comparison of drives asks here. Cost: n log n.
std::vector<std::size_t> DependentGroups(const truth::RecordSchema& schema,
                                         std::span<const truth::Record> records);

// The rate of `values` 0 and 1, NaN where a trial does not count, and the mean of any values: of
// groups as above, or of independent ones where `groups` is empty. The mean's interval is that of
// EstimateMean, by groups of what each adds to the mean, R + (x - R y) / mean y, sums x of y
// values, where values alone have one.
std::vector<double> OnesWhere(std::span<const truth::Record> records,
                              bool (*succeeded)(truth::TrialOutcome));
std::vector<double> OnesWhere(std::span<const truth::Record> records,
                              const std::function<bool(const truth::Record&)>& holds);
Proportion RateOfTrials(std::span<const double> values, std::span<const std::size_t> groups,
                        double confidence = kConfidence,
                        IntervalMethod method = IntervalMethod::kWilson);
MeanEstimate MeanOfTrials(std::span<const double> values, std::span<const std::size_t> groups,
                          std::int64_t fewest = kFewestForMean, double confidence = kConfidence);

// Values of trials of which some hang together, such as differences of paired successes.
class ClusteredValues {
 public:
  // Takes one value. Clusters are numbered from 0 and come in any order.
  void Add(std::size_t cluster, double value);

  // Returns as many independent values of the same mean and scatter as say as much about the mean:
  // by the design effect and quantiles above, and one for each cluster where all values are equal.
  // There are none with fewer than two clusters.
  SignedValues Effective(double confidence) const;

 private:
  std::vector<CountOfRun> clusters_;
  double squares_ = 0.0;
};

// Success counts when all runs of a set meet the same rock layout.
//
// Matthies 1995 (sec. 7) does not say whether the rocks were laid out anew for each run. With one
// layout per set the runs share the layout's own success rate, so that counts scatter more than a
// binomial. How much more needs repeated trials on one layout; without them it can only be bounded.

// Trials on one layout.
struct LayoutCount {
  std::int64_t successes = 0;
  std::int64_t trials = 0;
};

// The mean rate, and the correlation of two trials on one layout (0: layouts do not matter; 1: the
// layout decides), by the analysis-of-variance estimator (Fleiss 1981), the latter clamped to [0,
// 1]. The correlation is NaN when no layout has two trials or there is only one layout.
struct LayoutEffect {
  double rate = 0.0;
  double correlation = 0.0;
};
LayoutEffect EstimateLayoutEffect(std::span<const LayoutCount> layouts);

// Returns the predictive law of the successes of `trials` runs on one new layout: beta-binomial
// with the estimated rate and correlation, averaged over 400 resamples of the layouts (`seed`,
// Purpose::kBootstrap) so that the estimate's own uncertainty is included. It needs a finite
// correlation.
CountLaw OneLayoutLaw(std::int64_t trials, std::span<const LayoutCount> layouts,
                      std::uint64_t seed);

// Returns, without repeats, the smallest and the largest two-sided p-value over every way in which
// success rates can vary from layout to layout with mean rate p, averaged over the posterior Beta(K
// + 1/2, N - K + 1/2) of p. A tail probability is then a mixture of f(q) = P(Binomial(trials, q) in
// tail) with E q = p, hence lies between f's convex and concave hull at p.
Interval OneLayoutPValueBounds(std::int64_t trials, std::int64_t observed, std::int64_t count,
                               std::int64_t pool);

}  // namespace rockyard::statistics
