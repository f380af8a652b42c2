// How many trials a question needs: for `rockyard plan`, and for what a check against a baseline
// would have seen (regression_samples.h). No record depends on it, but in a check powers part
// kNoneSeen from kInconclusive, and so exit code 0 from 4
// (primary metrics).
#pragma once

#include <cstdint>
#include <vector>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// The most trials that are looked for; what needs more gives this number.
inline constexpr std::int64_t kMaxTrials = 1'000'000'000;

// Returns the number of trials whose interval, at the count nearest to `rate`, has at most this
// half-width; one trial less has more. 0 <= rate <= 1, 0 < half_width < 0.5. Cost: some dozens of
// intervals.
std::int64_t TrialsForHalfWidth(double rate, double half_width, double confidence,
                                IntervalMethod method);

// Returns the number of trials for this half-width where it ends the trials
// (IntervalMethod::kStopped), looked at every `block` of them: a block end. Single campaigns stop
// some blocks sooner or later.
std::int64_t TrialsForStopping(double rate, double half_width, double confidence,
                               std::int64_t block);

// Returns the number of trials after which at most `failures` failures show, with this confidence,
// that the failure rate is below `bound`: the smallest n with P(Binomial(n, bound) <= failures) <=
// 1 - confidence (Clopper and Pearson's one-sided upper end is then below the bound). For no
// failure and 95 % it is near 3 / bound, the rule of three (Hanley and Lippman-Hand 1983, JAMA 249,
// pp. 1743-1745).
std::int64_t TrialsForClaim(double bound, double confidence, std::int64_t failures);

// Returns the chance that n trials see no more than `failures` failures where the rate is `rate`.
double ClaimChance(std::int64_t trials, double rate, std::int64_t failures);

// Two rates, of two groups of n trials or of n pairs.
struct RatePair {
  double first = 0.0;
  double second = 0.0;
};

// Fisher's exact two-sided test of two groups of n, whose critical counts are kept, so that several
// rates cost little more than one.
class FisherTest {
 public:
  FisherTest(std::int64_t n, double alpha);

  // Returns the chance to reject, summed over all pairs of counts that are not too unlikely to
  // matter (1e-9 in all). The first call costs n^1.5 log n; 0.1 s for n = 2000.
  double Power(const RatePair& rates);

 private:
  std::int64_t Critical(std::int64_t successes);

  std::int64_t n_;
  double alpha_;
  std::vector<std::int64_t> critical_;  // by successes of both groups
};

double FisherPower(std::int64_t n, const RatePair& rates, double alpha);

// Returns the trials of each group for Fisher's test by the normal formula with continuity
// correction (Casagrande, Pike and Smith 1978, Biometrics 34, pp. 483-486). Its exact power is near
// the one asked for where both rates are far from 0 and 1, and above it (up to 0.18 for power 0.8)
// where they are not. The rates must differ. Cost: constant.
std::int64_t TrialsForFisherFormula(const RatePair& rates, double alpha, double power);

// TrialsForFisher returns that number by exact power, which is reached and is not with one trial
// less (exact power rises and falls with n: some smaller number may reach it as well), where the
// formula gives up to kMaxExactFisher trials; else it returns the formula's. Cost: up to a second.
inline constexpr std::int64_t kMaxExactFisher = 3000;
std::int64_t TrialsForFisher(const RatePair& rates, double alpha, double power);

// Returns the power of McNemar's exact test of n pairs; `discordant` are the rates of the pairs in
// which only the first, and only the second, succeeds; their sum is at most 1. Cost: linear.
double McNemarPower(std::int64_t n, const RatePair& discordant, double alpha);

// Returns the number of pairs for this power of McNemar's test; it is not reached with one pair
// less. (Exact power rises and falls with n: some smaller number may reach it as well.) The rates
// must differ.
std::int64_t TrialsForMcNemar(const RatePair& discordant, double alpha, double power);

// Returns the power of TOST on means if the true difference is 0 and standard_error that of the
// difference: 2 T(margin / standard_error - t) - 1, t Student's quantile (Phillips 1990, Journal of
// Pharmacokinetics and Biopharmaceutics 18, pp. 137-144, with the central law; within 0.02).
double EquivalencePower(double margin, double standard_error, double degrees_of_freedom,
                        double alpha);

// TrialsForEquivalence returns the trials of each group (or pairs) for TOST on means. `deviation`
// is the standard deviation of the values of a group (of the differences of pairs), in the unit of
// the margin.
enum class Pairing { kUnpaired, kPaired };
std::int64_t TrialsForEquivalence(double margin, double deviation, double alpha, double power,
                                  Pairing pairing);

}  // namespace rockyard::statistics
