// How the rows of the right image lie beside those of the left one, from matches of points.
// `rockyard stereo` aligns pairs without cameras by it, as the correlator searches along rows. No
// drive does, so that no record depends on it.
//
// Small errors of the right camera's pointing, roll and focal length, and of the place of its axis
// in the image, move its rows to first order by (its own column x, the left image's row y)
//   y_right - y = offset_px + per_column (x - (width - 1) / 2) + per_row (y - (height - 1) / 2).
// The three numbers start from the plane through three matches with which most matches agree
// (Fischler and Bolles 1981, triples from a Sobol sequence, so that nothing is random). Iterated
// least squares refines them with the weights (1 - (r / c)^2)^2 of residuals r below c = 4.685 s
// (Beaton and Tukey 1974), s being 1.4826 times the median of |r| of the matches that agree, at
// least 0.05 px.
#pragma once

#include "core/result.h"
#include "vision/image.h"
#include "vision/stereo/rectification_table.h"
#include "vision/stereo/row_matches.h"

namespace rockyard::vision {

struct RowCorrection {
  double offset_px = 0.0;
  double per_column = 0.0;  // of the right image, px a px
  double per_row = 0.0;

  // Returns the row of the right image, of the given size, that shows in its column `x` what stands
  // in row `y` of the left image.
  double RightRow(double x, double y, int width, int height) const;
};

struct RowAlignmentOptions {
  RowMatchOptions search;
  double agree_px = 1.0;   // rows between a match and the correction, above 0
  int min_agreeing = 20;   // matches, at least 3
  double min_share = 0.5;  // of all matches that must agree
};

struct RowAlignment {
  RowCorrection correction;
  int matches = 0;
  int agreeing = 0;     // matches within agree_px of the correction
  double rms_px = 0.0;  // of the agreeing ones, from the correction
};

// Returns the correction of `right`, or the problem: images of different sizes, too few matches
// that agree (or too small a share), or matches along a line, which leave a slope open. Limits:
// rows further apart than search.max_rows_px are not found. A roll moves columns too, which rows
// cannot tell, so that disparities keep an error of about per_column (y - middle). Bent rows
// (distortion, strong convergence) stay bent, and rms_px shows it.
core::Result<RowAlignment> FindRowAlignment(const GrayImage& left, const GrayImage& right,
                                            const RowAlignmentOptions& options = {});

// Returns the table that resamples the right image (of the given size, at least 2 x 2) to the rows
// of the left image. Columns stay as they are.
RectificationTable MakeRowTable(const RowCorrection& correction, int width, int height);

}  // namespace rockyard::vision
