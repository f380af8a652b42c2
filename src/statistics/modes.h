// Estimates of the mode of a sample. Matthies 1995 quotes modes without saying how they were found;
// the half-sample mode is the one that the comparison uses, the others are shown beside it.
#pragma once

#include <span>

namespace rockyard::statistics {

// Returns the half-sample mode (Robertson and Cryer 1974; Bickel and Fruehwirth 2006): it takes the
// shortest interval that holds half of the points, again and again, until three or fewer are left.
// It needs no bin and no bandwidth. `sorted` is ascending and finite; the mode is NaN when it is
// empty. Of equally short halves the lowest is taken. Cost: linear.
double HalfSampleMode(std::span<const double> sorted);

// Returns the middle of the fullest bin of a histogram with Freedman-Diaconis bins that start at
// the minimum (Sturges' number of bins where the quartiles coincide). Of equally full bins the
// lowest is taken.
double HistogramMode(std::span<const double> sorted);

// Returns the highest point of a Gaussian kernel density with Silverman's bandwidth 0.9 min(s,
// IQR/1.34) n^(-1/5) (Silverman 1986, eq. 3.31), found on a grid of 256 points from minimum to
// maximum and refined by a parabola. Cost: 256 n.
double KernelMode(std::span<const double> sorted);

}  // namespace rockyard::statistics
