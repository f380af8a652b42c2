// Success of the same trials under two settings.
#pragma once

#include <cstdint>

#include "statistics/proportions.h"

namespace rockyard::statistics {

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

SignedValues DifferencesOf(const PairedCounts& counts);  // second less first

// Returns the interval of their mean: that of the normal law after half a value of -1, half of +1
// and one of 0 are added (Agresti and Min 2005, Statistics in Medicine 24, pp. 729-740, section 3:
// half a pair more in each cell). It is near nominal, and no point where all values agree. Values
// must be independent. Without values it is [-1, 1].
Interval AgrestiMinInterval(const SignedValues& values, double confidence = kConfidence);

}  // namespace rockyard::statistics
