// The most likely motion of a pair of cameras that saw the same points twice.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "vision/cameras/rectification.h"
#include "vision/odometry/motion_estimate.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

struct EstimatedMotion {
  std::optional<Motion> motion;
  std::optional<NoMotion> reason;  // exactly where there is no motion
  std::int64_t iterations = 0;
  double fit = 0.0;     // chi-squared over degrees of freedom: 1 where the noise is as stated
  double rms_px = 0.0;  // of columns, rows and disparities
};

// Least squares from `start`. Unknown are the motion and where the points are; both moments'
// measurements m = (column, row, disparity) of every point count by their covariances:
//
//   minimize sum_i |m_Fi - h(p_i)|^2_(S_Fi) + |m_Si - h(X_SF p_i)|^2_(S_Si)
//
// h of pair_projection.h, |r|^2_S = r' S^-1 r. It is the maximum likelihood of normal noise in the
// images (Matthies 1989 weighs the same noise in space, to first order: far points, whose error in
// depth is skewed, bias that). Gauss-Newton with Levenberg's and Marquardt's damping; the points
// are eliminated (Schur complement), so that 6 x 6 equations are solved. A disturbance of the
// motion is that of MotionCovariance. Robust weights are those of a point's whole residual, by the
// root of its 3 degrees of freedom's mean. It ends where a step d has d' N d <= tolerance^2: that
// share of a standard deviation.
//
// The covariance is N^-1 times the larger of `fit` and 1: noise that is larger than stated shows in
// the residuals of hundreds of points. No motion where it does not end, where `fit` is above
// max_fit, and where a standard deviation is above its limit.
//
// Needs three points or more that are in front of the cameras at `start`. Cost: 0.6 us a point and
// iteration.
EstimatedMotion EstimateMotion(const PointsSeenTwice& points, const RectifiedPair& cameras,
                               const EstimationParams& params, const math::Transform& start);

}  // namespace rockyard::vision
