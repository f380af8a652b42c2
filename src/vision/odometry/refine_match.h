// Where a window of one image lies in another one, finer than a pixel: VisualOdometer finds matches
// in time by it, FeaturePlacer (place_features.h) features in the right eye.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"
#include "vision/odometry/feature.h"
#include "vision/odometry/window_samples.h"

namespace rockyard::vision {

// Limits of a search. Records depend on these max_shift_px and max_residual, which visual odometry
// does not set; the other numbers come from PlacementParams (odometer_params.h).
struct RefineLimits {
  bool along_row = false;      // searches columns only, as rows are epipolar lines
  double max_shift_px = 2.0;   // from where the search begins
  double max_residual = 20.0;  // grey levels
  double noise_px = 0.05;      // standard deviation of a place beyond what pixels' noise makes
  double slope_sd = 0.3;       // FindSlanted: standard deviation of slopes, before images say more
  double max_slope = 0.5;      // FindSlanted: slopes are cut there
};

struct RefinedPlace {
  Pixel pixel = Pixel::Zero();                               // in the second image
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  // along_row: of the column only
  double residual = 0.0;  // root mean square of the difference over the window, grey levels
};

// A window of up to 15 x 15 pixels about a place of the first image, as it looks in the second one.
class WindowTemplate {
 public:
  // Samples the window of the first image about `middle` as the second image shows it: `view` takes
  // offsets in the second image to offsets in the first (SampleWindow). The side is odd.
  WindowTemplate(const GrayImage& image, const Pixel& middle, const ViewChange& view = {},
                 std::size_t side = kTemplateRows);

  // Finds the shift s of the least sum of (second(start + s + o) - first(o))^2 over the window,
  // each less its mean (Lucas and Kanade 1981; inverse compositional, Baker and Matthews 2004):
  //   s <- s - N^-1 sum g r,   N = sum g g',   g the template's gradient, r the residual
  // until |ds| < 0.01 px, ten times at most. The covariance is sigma^2 N^-1 + noise_px^2 I, with
  // sigma^2 = sum r^2 / (n - 3) for n pixels. Returns nothing where the search does not end within
  // the limits, where the window has no texture, or where HasTemplate does not hold.
  std::optional<RefinedPlace> Find(const GrayImage& second, const Pixel& start,
                                   const RefineLimits& limits) const;

 private:
  // Sums over the window of d = second(start + s + o) - mean - (first(o) - mean), where both means
  // are that of the first image's window.
  struct Sums {
    float d = 0.0F;
    float across_d = 0.0F;
    float down_d = 0.0F;
    float squares = 0.0F;
  };
  Sums SumsAt(const GrayImage& second, const Pixel& middle) const;

  std::size_t side_;
  int reach_;
  float pixels_;
  WindowSamples samples_;  // values less their mean
  float mean_ = 0.0F;
  float across_sum_ = 0.0F;
  float down_sum_ = 0.0F;
  Eigen::Matrix2d normal_ = Eigen::Matrix2d::Zero();
};

// By how much the disparity of a plane grows with column and row, px/px: it is linear in both, as
// 1 / Z is.
using DisparitySlope = Eigen::Vector2d;

// Returns how the left eye sees what the right eye sees of a surface of this slope: at the offset
// ((o_x + slope_y o_y) / (1 - slope_x), o_y) what the right eye has at o.
ViewChange LeftViewOf(const DisparitySlope& slope);

struct SlantedPlace {
  double column = 0.0;  // in the right image
  DisparitySlope slope = DisparitySlope::Zero();
  double variance_px2 = 0.0;  // of the column
  double residual = 0.0;      // root mean square of the difference over the window, grey levels
};

// Finds where the right eye sees a small surface that need not face the cameras (least squares
// matching: Lucas and Kanade 1981, Gruen 1985): the column and the slope of the least sum of
// (right(column + o_x, row + o_y) - left(view o))^2 over side x side pixels o, each less its mean.
// Takes Gauss-Newton steps for shift and slope with g (1, o_x, o_y), g the gradient along the row
// of the left window as the right eye would see it, until both change by less than 0.02 px and
// 0.01, at most four; the last counts either way. Slopes have the standard deviation slope_sd
// before the images say more, and are cut at max_slope. The variance is sigma^2 times the shift's
// part of the inverse normal matrix, plus noise_px^2, with sigma^2 = sum r^2 / (n - 5), at least 1.
// Returns nothing where the search leaves its limits (rows are never searched) or the window the
// image. Cost: 2 us with 64 bytes a vector.
std::optional<SlantedPlace> FindSlanted(const GrayImage& left, const GrayImage& right,
                                        const Pixel& left_pixel, double column,
                                        const RefineLimits& limits,
                                        std::size_t side = kTemplateRows);

}  // namespace rockyard::vision
