// The 1-D correlator with its checks (Goldberg 2002 section 2, stages 4 and 5), row by row.
//
// For every pixel (x, y) of the left image and every disparity d of the range the score is the sum
// of absolute differences over the window, of side n, from n / 2 pixels before the pixel (rounded
// down) to n - 1 - n / 2 behind it, in both directions:
//   S(x, d) = sum over the window of |L(x + i, y + k) - R(x + i - d, y + k)|,
// small for a good match; a candidate is a pair of pixels whose windows both lie in their images.
//   left:   d_L(x) = the d of the smallest S(x, d), the smallest such d where several are equal
//   right:  d_R(x) = the same of S(x + d, d): both come out of one pass over the scores
//   line of sight: |d_L(x) - d_R(x - d_L(x))| <= 1 px (a parameter)
//   peak filter:   S(x, d_L - 1) and S(x, d_L + 1) exist and are larger than S(x, d_L); the
//   curvature
//                  c = S(x, d_L - 1) - 2 S(x, d_L) + S(x, d_L + 1) is at least side^2 times a
//                  parameter, and at least S(x, d_L) times another
//   sub-pixel:     the lowest point of a parabola through the three, or of two lines (SubPixel)
//
// Sums slide in both directions: a score gains the row that comes and loses the one that goes, and
// what it gains or loses in a row slides along the row, so that the time does not depend on the
// window.
#pragma once

#include "vision/image.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// Writes the disparities of rows first_row ... end_row - 1 of the left image; others stay as they
// are, and bands of rows may be written at the same time. `left` and `right`
// (DifferenceOfGaussians) and `out` are of one size, the parameters accepted by
// StereoPipelineParams::Visit, and values of images at most 2 params.dog.limit. Each band costs as
// much as window_side_px - 1 rows on top.
void CorrelateRows(const GrayImage& left, const GrayImage& right,
                   const StereoPipelineParams& params, int first_row, int end_row,
                   DisparityImage& out);

// Returns the name of the instruction set that the fast stages use on this machine, as in "AVX3".
const char* InstructionSet();

}  // namespace rockyard::vision
