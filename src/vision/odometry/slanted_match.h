// Where the right eye sees a small surface that need not face the cameras (least squares matching:
// Lucas and Kanade 1981, Gruen 1985).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/image.h"
#include "vision/odometry/refine_match.h"
#include "vision/odometry/view_change.h"

namespace rockyard::vision {

// A plane has a disparity that is linear in column and row (1 / Z is). By how much it grows with
// each, px/px.
using DisparitySlope = Eigen::Vector2d;

// How the left eye sees what the right one sees of a surface of this slope: at the offset
// ((o_x + slope_y o_y) / (1 - slope_x), o_y) where the right one has it at o.
ViewChange LeftViewOf(const DisparitySlope& slope);

struct SlantedPlace {
  double column = 0.0;  // in the right image
  DisparitySlope slope = DisparitySlope::Zero();
  double variance_px2 = 0.0;  // of the column
  double residual = 0.0;      // root mean square of what is left over the window, grey levels
};

// Finds column and slope of the least sum of (right(column + o_x, row + o_y) - left(view o))^2 over
// side x side pixels o, each less its mean: Gauss-Newton steps for shift and slope with g (1, o_x,
// o_y), g the gradient along the row of the left window as the right eye would see it, until both
// change by less than 0.02 px and 0.01, four times at most. Slopes have a standard deviation
// (slope_sd) before the images say more, and end at max_slope. The variance is that of
// refine_match.h with n - 5 pixels. Nothing where the search leaves its limits (along_row is meant)
// or the window the image. Cost: 2 us with 64 bytes a vector.
std::optional<SlantedPlace> FindSlanted(const GrayImage& left, const GrayImage& right,
                                        const Pixel& left_pixel, double column,
                                        const RefineLimits& limits,
                                        std::size_t side = kTemplateRows);

}  // namespace rockyard::vision
