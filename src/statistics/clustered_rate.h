// A rate of events that hang together within a run.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "statistics/paired_counts.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {

// A count of one run and what it is counted of.
struct CountOfRun {
  double count = 0.0;
  double base = 0.0;
};

// What is assumed of runs that all say the same: their dependence cannot be seen.
enum class WithoutScatter {
  kIndependent,  // whatever is counted within a run
  kOnePerRun,    // each run says as much as one trial
};

// Returns the interval of the ratio of both sums, where runs are independent and what happens
// within one is not (several hazards of one drive, trials on one layout). It is Clopper and
// Pearson's of effective numbers (Korn and Graubard 1998, Survey Methodology 24, pp. 193-201):
// counts and base are divided by the design effect, which is
//   max(1, runs Var(x - R y) / (n R (1 - R))),  x and y of the runs, R and n of all,
// and by the square of Student's over the normal quantile, for the few runs behind it. Fractions
// are rounded outwards.
// Limits: one run, or no base, says nothing: [0, 1]. 0 <= count <= base. Cost: linear.
Interval ClusteredRateInterval(std::span<const CountOfRun> runs, double confidence,
                               WithoutScatter unseen = WithoutScatter::kIndependent);

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
