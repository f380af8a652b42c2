// Pearson's chi-square test of binned counts.
#pragma once

#include <span>

namespace rockyard::statistics {

struct ChiSquareResult {
  double statistic = 0.0;
  int degrees_of_freedom = 0;
  double p_value = 1.0;
};

// Tests observed counts against expected ones (same total, same order). Neighbouring bins are
// pooled until each expects at least `min_expected` (Cochran's rule: 5). `fitted` parameters cost
// one degree of freedom each. p = 1 when fewer than one degree of freedom is left.
ChiSquareResult ChiSquareGoodnessOfFit(std::span<const double> observed,
                                       std::span<const double> expected, int fitted = 0,
                                       double min_expected = 5.0);

// Returns P(chi-square with `degrees_of_freedom` > statistic).
double ChiSquareTail(double statistic, int degrees_of_freedom);

}  // namespace rockyard::statistics
