// A rate of events that hang together within a run.
#pragma once

#include <span>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// A count of one run and what it is counted of.
struct CountOfRun {
  double count = 0.0;
  double base = 0.0;
};

// Interval of the ratio of both sums, where runs are independent and what happens within one is not
// (several hazards of one drive). Clopper and Pearson's of effective numbers (Korn and Graubard
// 1998, Survey Methodology 24, pp. 193-201): counts and base by the design effect, which is
//   max(1, runs Var(x - R y) / (n R (1 - R))),  x and y of the runs, R and n of all,
// and by the square of Student's over the normal quantile, for the few runs behind it. Fractions
// are rounded outwards.
// Limits: without any event (or nothing but events) the design effect cannot be seen and is 1; one
// run, or no base, says nothing: [0, 1]. 0 <= count <= base. Cost: linear.
Interval ClusteredRateInterval(std::span<const CountOfRun> runs, double confidence);

}  // namespace rockyard::statistics
