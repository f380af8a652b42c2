// Rates and means of trials that hang together, as those on one layout of rocks do, and success
// counts of runs that all met the same rocks. Summaries, sweeps, comparisons of runs and
// comparisons with published values ask here. No record depends on them, but verdicts and exit
// codes of checks with a tolerance do; OneLayoutLaw, which alone draws, is shown and not judged.
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

// Returns the interval of the ratio of the sum of counts to the sum of bases, where runs are
// independent and what happens within one is not (several hazards of one drive, trials on one
// layout). It is Clopper and Pearson's of effective numbers (Korn and Graubard 1998, Survey
// Methodology 24, pp. 193-201): counts and base are divided by the design effect, which is
//   max(1, runs Var(x - R y) / (n R (1 - R))),  x and y of the runs, R and n of all,
// and by the square of Student's over the normal quantile, for the few runs behind it. Fractions
// are rounded outwards. Fewer than five runs with an event, or with a trial without one, cannot
// show how far events hang together. Nor can up to thirty runs of which fewer than five would have
// (or lack) an event if each were one trial, as a run of nothing but events may well be missing.
// Each run then says as much as one trial. So the interval holds the rate in 93 % of samples and
// more (8 to 60 runs of 5 to 50 trials, rates of 3 to 90 %; tests/statistics/clustered_test.cc).
// Limits: one run, or no base, says nothing: [0, 1]. 0 <= count <= base. Cost: linear.
Interval ClusteredRateInterval(std::span<const CountOfRun> runs, double confidence);

// Returns the rate with its interval: that of independent trials, by RateMethod, where no run has
// more than one trial or `independent` says that all are; else ClusteredRateInterval.
Proportion RateOfRuns(std::span<const CountOfRun> runs, bool independent = false,
                      double confidence = kConfidence,
                      IntervalMethod method = IntervalMethod::kWilson);

// Returns the layout of rocks of each trial (the column "layout"; course.trials_per_layout). A
// drive that was never measured (truth::IsNavigatorCrash) tells none: it has the one that those
// beside it tell, as n trials after each other share one. NaN where nothing tells.
std::vector<double> LayoutsOf(const truth::RecordSchema& schema,
                              std::span<const truth::Record> records);

// Returns for each trial the number of its group, from 0. Trials of one group hang together, as
// they share a layout of rocks (the column "layout"; course.trials_per_layout). The list is empty
// where all trials are independent: no two share a layout, or no column tells. Every rate, mean and
// comparison of drives must ask here. Cost: n log n.
std::vector<std::size_t> DependentGroups(const truth::RecordSchema& schema,
                                         std::span<const truth::Record> records);

// Returns 1 for each record for which the condition holds, 0 for each other, NaN for simulator
// faults.
std::vector<double> OnesWhere(std::span<const truth::Record> records,
                              bool (*succeeded)(truth::TrialOutcome));
std::vector<double> OnesWhere(std::span<const truth::Record> records,
                              const std::function<bool(const truth::Record&)>& holds);

// RateOfTrials returns the rate of `values` 0 and 1, MeanOfTrials the mean of any values; NaN
// stands for a trial that does not count. `groups` are those of DependentGroups; trials are
// independent where it is empty. The interval of the mean is that of EstimateMean. With groups it
// is taken from what each adds to the mean, R + (x - R y) / mean y, where x is the sum of the y
// values of a group and R the mean; there is none where the values alone would have none.
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
  // by the design effect and quantiles of ClusteredRateInterval, and one for each cluster where all
  // values are equal. There are none with fewer than two clusters.
  SignedValues Effective(double confidence) const;

 private:
  std::vector<CountOfRun> clusters_;
  double squares_ = 0.0;
};

// Trials on one layout of rocks. Matthies 1995 (sec. 7) does not say whether the rocks were laid
// out anew for each run. If all runs of a set met one layout, they share its success rate, so that
// counts scatter more than a binomial. How much more needs repeated trials on one layout; without
// them it can only be bounded.
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
