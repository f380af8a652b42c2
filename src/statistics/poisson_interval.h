// The interval of a mean number from one count.
#pragma once

#include <cstdint>

#include "statistics/proportions.h"

namespace rockyard::statistics {

// Returns the exact two-sided interval of the mean of a Poisson number of which `count` >= 0 was
// seen (Garwood 1936, Biometrika 28): its ends are the means at which that many or more, or that
// many or fewer, have the probability (1 - confidence) / 2. Cost: constant.
Interval PoissonInterval(std::int64_t count, double confidence = kConfidence);

}  // namespace rockyard::statistics
