// The interval of a mean of skewed values, and when there is none.
#pragma once

#include <cstdint>
#include <span>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// No interval of a mean holds for every law (Bahadur and Savage 1956): values that a sample happens
// to miss may be as large as they like. These are the fewest for which the intervals below held the
// true mean in at least 93 % of samples of the project's own trials (results/studies/coverage.md).
inline constexpr std::int64_t kFewestForMean = 30;
inline constexpr std::int64_t kFewestApart = 10;  // values that differ from the commonest one
inline constexpr std::int64_t kNeverForMean = 0;

// Why a mean has no interval.
enum class MeanLack {
  kNone,          // it has one
  kTooFewValues,  // fewer than the law of the values needs
  kNothingApart,  // all values are the same, which is no proof that others do not occur
  kTooFewApart,   // most values are the same, and too few differ to say how much others may
  kNoBound,       // of values with such a tail no number of trials makes the mean known
};

struct MeanEstimate {
  Interval interval{};  // NaN where there is none
  MeanLack lack = MeanLack::kNone;
  std::int64_t needs = 0;  // of values, or values apart, of which there are too few
  double usual = 0.0;      // the commonest value, of equally common ones the lowest; NaN of nothing
  // The values that differ from it, with the exact interval of their share, which holds for any
  // law.
  Proportion apart{};
};

// Returns the interval of the mean of ascending, finite values: Student's (1908), each end moved
// out to that of Hall's transformed t (1992, Journal of the Royal Statistical Society B 54, pp.
// 221-228) where this is further out, and at most 1.75 times as far. Student's misses a mean of
// skewed values nearly always on the side of the long tail, Hall's somewhat on the other; the
// further of both misses on neither. The skewness of a sample is smaller than that of its law, more
// so the longer the tail: it is taken twice as large, which the study of coverage chose. Where the
// skewness is small for the number of values both are one. Cost: linear.
//
// With fewer values than `fewest` (kNeverForMean: with any number), or fewer than kFewestApart that
// differ from the commonest one, there is no interval: of rare events the share of `apart` says
// what is known.
MeanEstimate EstimateMean(std::span<const double> sorted, std::int64_t fewest = kFewestForMean,
                          double confidence = kConfidence);

// Returns the interval that EstimateMean gives where it gives one, whatever the number of values,
// at least two that are not all equal.
Interval SkewedMeanInterval(std::span<const double> values, double confidence = kConfidence);

// Returns the interval of the mean of the second less that of the first, independent, from the
// intervals of both: distances of the ends from the means, added in squares (Zou and Donner 2008,
// Statistics in Medicine 27, pp. 1693-1702). Unknown where either is.
Interval MeanDifferenceInterval(double first, const Interval& of_first, double second,
                                const Interval& of_second);

}  // namespace rockyard::statistics
