#include "statistics/paired_counts.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/distributions.h"

namespace rockyard::statistics {

void PairedCounts::Add(bool first, bool second) {
  if (first) {
    ++(second ? both : only_first);
  } else {
    ++(second ? only_second : neither);
  }
}

SignedValues DifferencesOf(const PairedCounts& counts) {
  return {.n = static_cast<double>(counts.pairs()),
          .sum = static_cast<double>(counts.only_second - counts.only_first),
          .squares = static_cast<double>(counts.only_second + counts.only_first)};
}

Interval AgrestiMinInterval(const SignedValues& values, double confidence) {
  EXPECT(confidence > 0.0 && confidence < 1.0);
  if (!(values.n > 0.0)) return {-1.0, 1.0};
  // Agresti and Min 2005: half a pair more in each of four cells adds 2 to n, 0 to the sum and 1 to
  // the squares; then the normal interval of the mean.
  const double n = values.n + 2.0;
  const double centre = values.sum / n;
  const double variance = (values.squares + 1.0) / n - centre * centre;
  const double half =
      core::NormalQuantile(0.5 + 0.5 * confidence) * std::sqrt(std::max(0.0, variance) / n);
  return {std::max(-1.0, centre - half), std::min(1.0, centre + half)};
}

}  // namespace rockyard::statistics
