// Quantiles and empirical distribution functions.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "statistics/proportions.h"

namespace rockyard::statistics {

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

}  // namespace rockyard::statistics
