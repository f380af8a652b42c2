// What one count says of its mean, and what a simulated pool predicts for a count in a small set of
// real runs.
//
// If simulation and reality follow one law, then n new runs beside a pool with K of N show k with
// probability BetaBinomial(k; n, K + 1/2, N - K + 1/2): the posterior predictive under Jeffreys'
// prior, the exact limit of drawing many samples of n from many resampled pools. It carries the
// simulation's own uncertainty and tends to Binomial(n, K/N) as the pool grows.
#pragma once

#include <cstdint>
#include <vector>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// Returns the exact two-sided interval of the mean of a Poisson number of which `count` >= 0 was
// seen (Garwood 1936, Biometrika 28): its ends are the means at which that many or more, or that
// many or fewer, have the probability (1 - confidence) / 2. Cost: constant.
Interval PoissonInterval(std::int64_t count, double confidence = kConfidence);

// The probabilities of the counts 0..n. They sum to 1.
using CountLaw = std::vector<double>;

CountLaw BinomialLaw(std::int64_t trials, double rate);

// Returns the law of a count whose rate has the beta law of a, b > 0.
CountLaw BetaBinomialLaw(std::int64_t trials, double a, double b);

// Returns the predictive law described above, for `count` of `pool` simulated runs and `trials` new
// ones.
CountLaw PredictiveCountLaw(std::int64_t trials, std::int64_t count, std::int64_t pool);

// Returns the smallest count whose cumulative probability reaches `probability`.
std::int64_t CountQuantile(const CountLaw& law, double probability);

// P(count <= observed) and P(count >= observed).
struct Tails {
  double lower = 1.0;
  double upper = 1.0;
};
Tails CountTails(const CountLaw& law, std::int64_t observed);

// Returns twice the smaller tail, at most 1: the two-sided p-value that matches equal-tailed
// intervals.
double TwoSided(const Tails& tails);

// Returns the probability that a count drawn from `truth` is rejected at `level` by the two-sided
// test of `null`. Both laws are over the same number of trials.
double CountPower(const CountLaw& null, const CountLaw& truth, double level);

}  // namespace rockyard::statistics
