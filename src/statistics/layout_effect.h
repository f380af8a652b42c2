// Success counts when all runs of a set meet the same rock layout.
//
// Matthies 1995 (sec. 7) does not say whether the rocks were laid out anew for each run. With one
// layout per set the runs share the layout's own success rate, so that counts scatter more than a
// binomial. How much more needs repeated trials on one layout; without them it can only be bounded.
#pragma once

#include <cstdint>
#include <span>

#include "statistics/counts.h"

namespace rockyard::statistics {

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
