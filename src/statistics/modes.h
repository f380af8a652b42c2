// Estimates of the mode of a sample. Matthies 1995 quotes modes without saying how they were found;
// the half-sample mode is the one that the comparison uses, the others are shown beside it.
#pragma once

#include <span>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// Returns the half-sample mode (Robertson and Cryer 1974; Bickel and Fruehwirth 2006): it takes the
// shortest interval that holds half of the points, again and again, until three or fewer are left.
// It needs no bin and no bandwidth. `sorted` is ascending and finite; the mode is NaN when it is
// empty. Of equally short halves the lowest is taken. Cost: linear.
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

}  // namespace rockyard::statistics
