// Line-of-sight check, peak filter and sub-pixel interpolation of one pixel, all in whole numbers.
//
// With the scores s-, s0, s+ at the best disparity and its two neighbours (sums of absolute
// differences: smaller is better), the parabola through them has the curvature and the lowest point
//   c = s- - 2 s0 + s+,      delta = (s- - s+) / (2 c),  |delta| <= 1/2
// since s- > s0 and s+ > s0 by the peak filter (Goldberg 2002 section 2 stage 5; section 3,
// "Compute Sub-Pixel"; the parabola is ours, the paper says "quadratic").
#pragma once

#include <cstdint>

#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// The parameters of the filters in the units of scores.
struct PeakLimits {
  int line_of_sight;       // largest difference of the two disparities, px
  std::int32_t curvature;  // smallest c
  std::int32_t ratio_256;  // smallest 256 c / s0
};

// side^2 pixels contribute to a score; limits are rounded up to whole scores.
PeakLimits MakePeakLimits(const StereoFilterParams& filters, const CorrelatorParams& correlator);

// Returns the disparity of the lowest point in 1/32 px, rounded to the nearest, halves upwards:
// floor(32 delta + 1/2). s- and s+ are above s0. By floor((32 (s- - s+) + 33 c) / (2 c)) - 16,
// whose numerator is positive.
constexpr int SubPixel(std::int32_t below, std::int32_t best, std::int32_t above) {
  const std::int32_t curvature = below - 2 * best + above;
  return (kDisparityOne * (below - above) + (kDisparityOne + 1) * curvature) / (2 * curvature) -
         kDisparityOne / 2;
}

}  // namespace rockyard::vision
