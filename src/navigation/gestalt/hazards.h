// The hazard formulas of GESTALT (Goldberg 2002, section 4, step 3).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "navigation/gestalt/map_params.h"

namespace rockyard::navigation {

// Returns a goodness in [0, 255] as 8 bits: to the nearest, halves up. The paper does not say how
// it rounds; cutting off would give up to one less.
inline std::int64_t ToGoodness(double goodness) { return std::lround(goodness); }

inline constexpr std::int64_t kBestGoodness = 255;

// Returns the goodness for the largest difference e of elevation in a patch: 127 (1 - min(1, e/h))
// from e = h/3 on, and not below `obstacle`; below h/3 there is no hazard.
inline std::int64_t StepGoodness(double step_m, double h_m, std::int64_t obstacle) {
  if (step_m < h_m / 3.0) return kBestGoodness;
  return std::max(obstacle, ToGoodness(127.0 * (1.0 - std::min(1.0, step_m / h_m))));
}

// Returns the goodness for the residual r of a patch's plane, with the fraction f: from r = f h/3
// on 255 (1 - min(1, f r/h)) as printed, or 255 (1 - min(1, r/(f h))), and not below `obstacle`.
inline std::int64_t RoughnessGoodness(double residual_m, double h_m, double fraction,
                                      RoughnessFormula formula, std::int64_t obstacle) {
  if (residual_m < fraction * h_m / 3.0) return kBestGoodness;
  const double ratio = formula == RoughnessFormula::kAsPrinted ? fraction * residual_m / h_m
                                                               : residual_m / (fraction * h_m);
  return std::max(obstacle, ToGoodness(255.0 * (1.0 - std::min(1.0, ratio))));
}

// Returns the goodness for the slope s of a patch's plane: 255 (1 - min(1, s/max_pitch)), at every
// slope, and not below `obstacle`.
inline std::int64_t PitchGoodness(double slope_rad, double max_pitch_rad, std::int64_t obstacle) {
  return std::max(obstacle, ToGoodness(255.0 * (1.0 - std::min(1.0, slope_rad / max_pitch_rad))));
}

}  // namespace rockyard::navigation
