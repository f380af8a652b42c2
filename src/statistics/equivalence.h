// Differences of means and of rates: are they there, and are they small enough not to matter?
// Checks against baselines and comparisons of two runs ask here.
//
// "Not significant" is not "equal". Equivalence is shown by two one-sided tests (TOST; Schuirmann
// 1987, Journal of Pharmacokinetics and Biopharmaceutics 15, pp. 657-680): the difference is not at
// or below -margin, and not at or above +margin. Its p-value is the larger one of both; at or below
// alpha it says the same as that the interval of confidence 1 - 2 alpha lies between the margins.
//
// No record depends on it, but verdicts and exit codes of checks against baselines do.
#pragma once

#include <cstdint>
#include <span>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// A difference of means that follows Student's law about the true one.
struct MeanDifference {
  double difference = 0.0;  // second less first; NaN where either is empty
  double standard_error = 0.0;
  double degrees_of_freedom = 0.0;  // 0: one value or none, so that nothing can be said
  // The chance of values that agree so well by accident, where nothing scatters (standard_error 0).
  double accident = 1.0;

  bool known() const { return degrees_of_freedom > 0.0; }
};

// Returns the mean difference of pairs from their differences (Student 1908). Values must be
// finite.
MeanDifference PairedMeans(std::span<const double> differences);

// Returns the mean difference of two independent samples (Welch 1947, Biometrika 34, pp. 28-35).
// Values must be finite.
MeanDifference WelchMeans(std::span<const double> first, std::span<const double> second);

// These return the interval of the difference, the p-value of no difference and that of
// equivalence. Limits: the means must be near normal, which some dozens of values without a heavy
// tail make them. Welch's test with groups of unlike size and skewed values does not keep a small
// level: give it groups of one size. Where nothing is known p = 1 and the interval is unbounded.
// Where nothing scatters the law is not Student's, and what is left is a sign test: all n pairs of
// one sign have p = 2^(1 - n), two groups of n that are apart 2 / C(2 n, n).
Interval DifferenceInterval(const MeanDifference& means, double confidence = kConfidence);
double ChangePValue(const MeanDifference& means);  // two-sided, of no difference
double EquivalencePValue(const MeanDifference& means, double margin);  // TOST, margin > 0

// Returns the p-value of equivalence of pairs of which few differ, where a standard error says
// nothing of what was not seen. A difference is at most `range`, so that the mean moves by the
// margin only if a share of margin / range of all pairs differs, or more: P(Binomial(pairs, margin
// / range) <= differing). With a range of 0 (all values were the same) a change in a twentieth of
// the pairs would have shown.
double SparseEquivalencePValue(std::int64_t pairs, std::int64_t differing, double margin,
                               double range);

// Returns the score interval of the rate of the second less that of the first (Tango 1998,
// Statistics in Medicine 17, pp. 891-908): asymptotic, exact coverage is near nominal from some
// dozens of pairs on, also where hardly any pair is discordant. The p-value is of TOST by the same
// score with a continuity correction of half a pair, by which its exact size stays at or below 0.05
// (tested for 10 to 100 pairs and margins of 0.05 to 0.3). Without pairs the interval is [-1, 1]
// and p is 1. McNemarExactPValue is the test of no difference that goes with both.
Interval DifferenceInterval(const PairedCounts& counts, double confidence = kConfidence);
double EquivalencePValue(const PairedCounts& counts, double margin);

// Returns the score interval, and TOST, of two independent rates, success_2 less success_1
// (Farrington and Manning 1990, Statistics in Medicine 9, pp. 1447-1454; the interval is that of
// Miettinen and Nurminen 1985 without their factor n / (n - 1)). The test has a continuity
// correction, too, of half a trial of each group: exact size at or below 0.05, tested for groups of
// 10 to 100. Where a group is empty the interval is [-1, 1] and p is 1. FisherExactPValue is the
// test of no difference that goes with both.
Interval DifferenceInterval(const ContingencyTable& table, double confidence = kConfidence);
double EquivalencePValue(const ContingencyTable& table, double margin);

}  // namespace rockyard::statistics
