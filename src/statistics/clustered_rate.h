// Which trials hang together, and what a rate or a mean of such trials says.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "statistics/mean_interval.h"
#include "statistics/proportions.h"
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

}  // namespace rockyard::statistics
