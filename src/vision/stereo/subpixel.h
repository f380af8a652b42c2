// Peak filter and sub-pixel interpolation of one pixel, all in whole numbers.
//
// With the scores s-, s0, s+ at the best disparity and its two neighbours (sums of absolute
// differences: smaller is better), curvature c = s- - 2 s0 + s+, the lowest point lies off the best
// disparity by
//   quadratic    delta = (s- - s+) / (2 c)                       the parabola through all three
//   equiangular  delta = (s- - s+) / (2 (max(s-, s+) - s0))      lines of slopes +m and -m
// where |delta| <= 1/2, as s- > s0 and s+ > s0 by the peak filter. Goldberg 2002 section 3
// ("Compute Sub-Pixel") says quadratic. Near its lowest point a sum of absolute differences of
// images that fit but for their place is a pair of lines and no parabola: of a true offset t, s- -
// s+ = 2 t sum|g| and c = 2 sum|g| (1 - |t|) with g the gradient along the row, so that the
// parabola says t / (2 (1 - |t|)), half of a small t, and the lines say t. They are the default.
#pragma once

#include <cstdint>

#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// The parameters of the filters in the units of scores.
struct PeakLimits {
  Interpolation interpolation;
  int line_of_sight;       // largest difference of the two disparities, px
  std::int32_t curvature;  // smallest c
  std::int32_t ratio_256;  // smallest 256 c / s0
};

// side^2 pixels contribute to a score; limits are rounded up to whole scores.
PeakLimits MakePeakLimits(const StereoFilterParams& filters, const CorrelatorParams& correlator);

// Returns 32 delta rounded to the nearest, halves upwards, floor(32 delta + 1/2), with m = c or
// max(s-, s+) - s0: floor((32 (s- - s+) + 33 m) / (2 m)) - 16, whose numerator is positive.
constexpr int SubPixel(Interpolation interpolation, std::int32_t below, std::int32_t best,
                       std::int32_t above) {
  const std::int32_t steepness = interpolation == Interpolation::kQuadratic
                                     ? below - 2 * best + above
                                     : (below > above ? below : above) - best;
  return (kDisparityOne * (below - above) + (kDisparityOne + 1) * steepness) / (2 * steepness) -
         kDisparityOne / 2;
}

}  // namespace rockyard::vision
