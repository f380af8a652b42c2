// Simulated time in whole physics steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace rockyard::trial {

// What is asked for in seconds happens in whole steps of the rover: a control tick of 1/25 s takes
// two steps of 1/60 s. duration_s is the time of these steps, and all that steers, measures or
// keeps books goes by it, never by the time asked for.
struct Stretch {
  std::int64_t steps = 1;
  double duration_s = 0.0;
};

// The nearest whole number of steps, one at least.
inline Stretch WholeSteps(double asked_s, double step_s) {
  const std::int64_t steps = std::max<std::int64_t>(1, std::llround(asked_s / step_s));
  return {steps, static_cast<double>(steps) * step_s};
}

}  // namespace rockyard::trial
