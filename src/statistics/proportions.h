// Rates and counts of independent trials: intervals, exact tests, predictions. Every rate that the
// program reports has its interval from here; rates of trials that hang together come by
// clustered_rate.h. Stores depend on one thing here: the interval kStopped decides how many trials
// a campaign with a stopping rule runs (batch/work_plan.cc). All else decides numbers of reports
// and verdicts.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace rockyard::statistics {

// The confidence of every interval, unless a caller asks for another. Must stay: reports write "95
// %" and "ci95" for it without asking.
inline constexpr double kConfidence = 0.95;

// Two ends of an interval, low <= high.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};

enum class IntervalMethod {
  kWilson,          // score interval (Wilson 1927): coverage near nominal on average
  kClopperPearson,  // exact (Clopper and Pearson 1934): coverage at least nominal, always
  kStopped,    // Clopper and Pearson's, for trials that end once their interval is narrow enough
  kClustered,  // of trials that hang together (clustered_rate.h); none of plain counts
};

// Returns the name in summary.json: "wilson", "clopper_pearson", "clopper_pearson_stopped",
// "clustered".
std::string_view MethodName(IntervalMethod method);

// Returns the method of a rate's interval where `method` is asked for: Clopper and Pearson's in
// place of Wilson's where there are fewer than five trials of either kind. Wilson's covers rare
// events in as few as 84 % of samples, whatever the number of trials, and so mended in no fewer
// than 92 % (exact sums at 20 to 1000 trials; tests/statistics/proportions_test.cc).
IntervalMethod RateMethod(std::int64_t count, std::int64_t trials, IntervalMethod method);

// A rate with its interval. With no trials the rate is NaN and the interval [0, 1].
struct Proportion {
  std::int64_t count = 0;
  std::int64_t trials = 0;
  double rate = 0.0;
  Interval interval;
  IntervalMethod method = IntervalMethod::kWilson;  // of the interval
};

// Returns the two-sided interval of a binomial proportion, with 0 <= count <= trials and 0 <
// confidence < 1. For no success (or no failure) Clopper-Pearson's upper (lower) end is the exact
// form of the "rule of three". Cost: constant.
//
// kStopped: where trials go on until the interval has some half-width, their number depends on what
// they say, and Clopper and Pearson's interval misses a little more often than stated. It is taken
// at 0.8 of the chance to miss (kStoppedShare), which costs a tenth more trials: by enumeration of
// all paths its coverage is at least 0.945 for 0.95 (half-widths 0.03 to 0.15, looks at each to
// each 100th trial, rates 0.01 to 0.99; without the factor 0.940). That is for a stop at a
// half-width or at a largest number of trials, not for whoever stops because the rate pleases.
Interval ProportionInterval(std::int64_t count, std::int64_t trials,
                            double confidence = kConfidence,
                            IntervalMethod method = IntervalMethod::kWilson);

// Returns Clopper and Pearson's interval of counts that need not be whole, 0 <= count <= trials: of
// n trials that hang together as the fewer independent ones that say as much. Cost: constant.
Interval ExactInterval(double count, double trials, double confidence = kConfidence);

// Returns the rate with its interval, by RateMethod.
Proportion MakeProportion(std::int64_t count, std::int64_t trials, double confidence = kConfidence,
                          IntervalMethod method = IntervalMethod::kWilson);

// Returns the interval of the difference second less first of two independent rates: the distances
// of the Wilson ends from the rates, added in squares (Newcombe 1998, Statistics in Medicine 17,
// pp. 873-890, method 10); for clustered trials by the ends of their own intervals (Zou and Donner
// 2008). It is near nominal on average; [-1, 1] where either has no trials. Cost: constant.
Interval DifferenceInterval(const Proportion& first, const Proportion& second,
                            double confidence = kConfidence);

// A 2 x 2 table: rows are two groups, columns are success and failure.
struct ContingencyTable {
  std::int64_t success_1 = 0;
  std::int64_t failure_1 = 0;
  std::int64_t success_2 = 0;
  std::int64_t failure_2 = 0;
};

// Returns the two-sided p-value of Fisher's exact test given all margins: the total probability of
// the tables that are no more probable than the one observed (relative tolerance 1e-7). An empty
// table gives 1. Cost: linear in the smallest margin.
double FisherExactPValue(const ContingencyTable& table);

// Returns the p-value of McNemar's exact test of paired runs (same seeds under two settings): the
// arguments are the pairs in which only the first, or only the second, succeeded; under the null
// each is a fair coin. Two-sided it is twice the smaller tail, at most 1.
double McNemarExactPValue(std::int64_t only_first, std::int64_t only_second);

// Counts of pairs by which side succeeded.
struct PairedCounts {
  std::int64_t both = 0;
  std::int64_t only_first = 0;
  std::int64_t only_second = 0;
  std::int64_t neither = 0;

  std::int64_t pairs() const { return both + only_first + only_second + neither; }
  void Add(bool first, bool second);
};

// Sums over values between -1 and +1, such as differences of paired successes. They are real
// numbers, so that n dependent values may enter as the fewer independent ones that say as much.
struct SignedValues {
  double n = 0.0;
  double sum = 0.0;
  double squares = 0.0;
};

// Returns the interval of their mean: that of the normal law after half a value of -1, half of +1
// and one of 0 are added (Agresti and Min 2005, Statistics in Medicine 24, pp. 729-740, section 3:
// half a pair more in each cell). It is near nominal, and no point where all values agree. Values
// must be independent. Without values it is [-1, 1].
Interval AgrestiMinInterval(const SignedValues& values, double confidence = kConfidence);

// Returns the exact two-sided interval of the mean of a Poisson number of which `count` >= 0 was
// seen (Garwood 1936, Biometrika 28): its ends are the means at which that many or more, or that
// many or fewer, have the probability (1 - confidence) / 2. Cost: constant.
Interval PoissonInterval(std::int64_t count, double confidence = kConfidence);

// The probabilities of the counts 0..n. They sum to 1.
using CountLaw = std::vector<double>;

CountLaw BinomialLaw(std::int64_t trials, double rate);

// Returns the law of a count whose rate has the beta law of a, b > 0.
CountLaw BetaBinomialLaw(std::int64_t trials, double a, double b);

// Returns the predictive law of the count of `trials` new runs beside `count` of `pool` simulated
// ones. If simulation and reality follow one law, then n new runs beside a pool with K of N show k
// with probability BetaBinomial(k; n, K + 1/2, N - K + 1/2): the posterior predictive under
// Jeffreys' prior, the exact limit of drawing many samples of n from many resampled pools. It
// carries the simulation's own uncertainty and tends to Binomial(n, K/N) as the pool grows.
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
