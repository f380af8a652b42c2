// One sample: moments, quantiles, distribution function, modes, and the interval of its mean.
// Summaries, comparisons and checks describe columns and metrics by it. No record depends on them;
// verdicts of comparisons and checks do.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// Count, mean, variance and extremes of a stream of values in one pass (Welford 1962), mergeable
// (Chan, Golub and LeVeque 1983). Values that are not finite are counted apart and otherwise left
// out. Merging in a fixed order gives the same bits whatever the threads did.
class Moments {
 public:
  void Add(double value);
  void Merge(const Moments& other);

  std::int64_t count() const { return count_; }
  std::int64_t not_finite() const { return not_finite_; }
  double mean() const;                // NaN when empty
  double variance() const;            // unbiased; NaN below two values
  double standard_deviation() const;  // root of the unbiased variance
  double min() const;                 // NaN when empty
  double max() const;                 // NaN when empty

 private:
  std::int64_t count_ = 0;
  std::int64_t not_finite_ = 0;
  double mean_ = 0.0;
  double sum_of_squares_ = 0.0;  // of the deviations from the mean
  double min_ = 0.0;
  double max_ = 0.0;
};

Moments MomentsOf(std::span<const double> values);

// Returns the finite values in ascending order (NaN and infinities are left out).
std::vector<double> SortedFinite(std::span<const double> values);

// Returns the quantile of type 7 (Hyndman and Fan 1996): linear between order statistics, the
// default of R and NumPy. `sorted` is ascending, 0 <= probability <= 1. It is NaN when empty.
double Quantile(std::span<const double> sorted, double probability);

// Returns the interval of the median from two order statistics, whose ranks the binomial law of the
// values below it gives (Thompson 1936): it covers with at least this confidence whatever the
// continuous law. `sorted` is ascending; the ends are NaN where so few values cannot give the
// confidence (below 6 at 95 %).
Interval MedianInterval(std::span<const double> sorted, double confidence = kConfidence);

// How much of the curve a band covers at once.
enum class BandMethod {
  kSimultaneous,  // Dvoretzky-Kiefer-Wolfowitz with Massart's constant (1990): the whole curve
  kPointwise,     // Clopper-Pearson at each point on its own
};

// One step of an empirical distribution function: at and right of `value` the function is
// `fraction`.
struct EcdfPoint {
  double value = 0.0;
  double fraction = 0.0;
  Interval band;
};

// Returns the empirical distribution function of the finite values, one point per distinct value.
// `independent`: of how many independent values the simultaneous band is, where that is not their
// number.
std::vector<EcdfPoint> Ecdf(std::span<const double> values, double confidence = kConfidence,
                            BandMethod method = BandMethod::kSimultaneous,
                            std::optional<double> independent = {});

// Returns the half-sample mode (Robertson and Cryer 1974; Bickel and Fruehwirth 2006): it takes the
// shortest interval that holds half of the points, again and again, until three or fewer are left.
// It needs no bin and no bandwidth. Matthies 1995 quotes modes without saying how they were found;
// the comparison with published values uses this one and shows HistogramMode and KernelMode beside
// it. `sorted` is ascending and finite; the mode is NaN when it is empty. Of equally short halves
// the lowest is taken. Cost: linear.
double HalfSampleMode(std::span<const double> sorted);

// Returns how far the half-sample mode of the law may lie from that of the sample, by subsampling
// (Politis, Romano and Wolf 1999, sec. 2.2): the spread of the modes of at most 100 blocks of
// n^(2/3) values (1000 at most) that follow each other in `values`, which must be independent and
// in no order, shrunk to n values at the rate n^(1/3) of an estimator of shortest intervals. No
// coverage is claimed: where a law has several near-modes, the mode of a sample jumps between them
// at any size. NaN below 30 finite values. Cost: 100 blocks, sorted.
Interval HalfSampleModeRange(std::span<const double> values, double confidence = kConfidence);

// Returns the middle of the fullest bin of a histogram with Freedman-Diaconis bins that start at
// the minimum (Sturges' number of bins where the quartiles coincide). Of equally full bins the
// lowest is taken.
double HistogramMode(std::span<const double> sorted);

// Returns the highest point of a Gaussian kernel density with Silverman's bandwidth 0.9 min(s,
// IQR/1.34) n^(-1/5) (Silverman 1986, eq. 3.31), found on a grid of 256 points from minimum to
// maximum and refined by a parabola. Cost: 256 n.
double KernelMode(std::span<const double> sorted);

// No interval of a mean holds for every law (Bahadur and Savage 1956): values that a sample happens
// to miss may be as large as they like. kFewestForMean values, kFewestApart of them apart, are the
// fewest for which EstimateMean's intervals held the true mean in at least 93 % of samples of the
// project's own trials (results/studies/coverage.md).
inline constexpr std::int64_t kFewestForMean = 30;
inline constexpr std::int64_t kFewestApart = 10;  // values that differ from the commonest one
inline constexpr std::int64_t kNeverForMean = 0;  // no number is enough

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
  // The values that differ from `usual`, with the exact interval of their share, which holds for
  // any law.
  Proportion apart{};
};

// Returns the interval of the mean of ascending, finite values: Student's (1908), each end moved
// out to that of Hall's transformed t (1992, Journal of the Royal Statistical Society B 54, pp.
// 221-228) where this is further out, and at most 1.75 times as far. Student's misses a mean of
// skewed values nearly always on the side of the long tail, Hall's somewhat on the other; the
// further of both misses on neither. The skewness of a sample is smaller than that of its law, more
// so the longer the tail: it is taken twice as large, which the study of coverage chose. Where the
// skewness is small for the number of values both ends are one. Cost: linear.
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
// Statistics in Medicine 27, pp. 1693-1702). NaN where either interval is NaN.
Interval MeanDifferenceInterval(double first, const Interval& of_first, double second,
                                const Interval& of_second);

}  // namespace rockyard::statistics
