// A motion of a pair of cameras between two moments, or why there is none, and its estimation from
// points. VisualOdometer returns these motions; drives take the rover's motion and slip from them,
// `rockyard vo` joins them to a path, and the error model of visual odometry (sensing) draws such
// motions without images. Records of drives with visual odometry depend on every bit of
// EstimateMotion, the order of its sums over points included; on Compose only paths of `rockyard
// vo`.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "math/pose.h"
#include "vision/cameras/rectification.h"
#include "vision/odometry/odometer_params.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

// The covariance of the error (e_t, e_r) of a motion, translation and rotation vector, m and rad,
// both told in the first frame F: R = exp([e_r]x) R_estimated, p = p_estimated + e_t.
using MotionCovariance = Eigen::Matrix<double, 6, 6>;

struct Motion {
  // F and S are the outer frame of the cameras at the first and the second moment, p_F = X_FS p_S.
  math::Transform X_FS = math::Transform::Identity();
  MotionCovariance covariance = MotionCovariance::Zero();
};

// Why there is no motion. Must stay: new reasons go to the end, as journals of `rockyard vo` hold
// the numbers and results the names (below).
enum class NoMotion {
  kFewFeatures,      // an image has too few corners
  kFewMatches,       // too few corners look alike
  kFewPoints,        // too few matches have a place, seen by both eyes
  kNoConsistentSet,  // too few points moved as one rigid body
  kNotConverged,     // least squares did not end
  kPoorFit,          // the residuals are larger than the measurements' noise explains
  kUncertain,        // a standard deviation is above its limit
  kNoImages,         // the images could not be read; the odometer never sees such a pair
};

struct MotionCounts {
  std::int64_t features_first = 0;  // of the left images
  std::int64_t features_second = 0;
  std::int64_t matches = 0;     // between the two left images
  std::int64_t points = 0;      // matches with a place at both moments
  std::int64_t consistent = 0;  // points that moved as one
  std::int64_t iterations = 0;  // of least squares
};

// The result of comparing two pairs of images: a motion, or the reason why there is none.
struct MotionResult {
  std::optional<Motion> motion;
  std::optional<NoMotion> reason;  // exactly where pairs were compared and there is no motion
  MotionCounts counts;
  double rms_px = 0.0;  // root mean square residual of the consistent set; 0 without one
};

// Returns the motion from A to C by way of B, if the errors of both parts are independent and
// small. With the errors of MotionCovariance, each told in the first frame of its part,
//   e_r = e_rAB + R_AB e_rBC        e_t = e_tAB + R_AB e_tBC - [R_AB p_BC]x e_rAB,
// so that the covariance is J_AB C_AB J_AB' + J_BC C_BC J_BC', told in A.
Motion Compose(const Motion& A_to_B, const Motion& B_to_C);

// The most likely motion of a pair of cameras that saw the same points twice.
struct EstimatedMotion {
  std::optional<Motion> motion;
  std::optional<NoMotion> reason;  // exactly where there is no motion
  // Where least squares ended, and whether by their tolerance. Without a motion X_FS is only good
  // as the start of another estimate.
  math::Transform X_FS = math::Transform::Identity();
  bool converged = false;
  std::int64_t iterations = 0;
  double fit = 0.0;     // chi-squared over degrees of freedom: 1 where the noise is as stated
  double rms_px = 0.0;  // of columns, rows and disparities
};

// Estimates the motion and where the points are by least squares from `start`. Both moments'
// measurements m = (column, row, disparity) of every point count by their covariances:
//
//   minimize sum_i |m_Fi - h(p_i)|^2_(S_Fi) + |m_Si - h(X_SF p_i)|^2_(S_Si)
//
// h is PairProjection, |r|^2_S = r' S^-1 r. This is the maximum likelihood for normal noise in the
// images. (Matthies 1989 weighs the same noise in space, to first order, which far points bias, as
// their error in depth is skewed.) The method is Gauss-Newton with Levenberg's and Marquardt's
// damping; the points are eliminated (Schur complement), so that 6 x 6 equations are solved. The
// unknowns of the motion are the (e_t, e_r) of MotionCovariance. A point has one robust weight, by
// the root of the mean of its squared residuals over its 3 degrees of freedom. The iteration ends
// where a step d has d' N d <= tolerance^2, so that it is that share of a standard deviation.
//
// The covariance is N^-1 times the larger of `fit` and 1: noise that is larger than stated shows in
// the residuals of hundreds of points. There is no motion where the iteration does not end, where
// `fit` is above max_fit, and where a standard deviation is above its limit.
//
// Requires three points or more, in front of the cameras at `start`. Cost: 0.6 us a point and
// iteration.
EstimatedMotion EstimateMotion(const PointsSeenTwice& points, const RectifiedPair& cameras,
                               const EstimationParams& params, const math::Transform& start);

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::NoMotion> {
  static constexpr std::array<std::string_view, 8> kNames{
      "few_features",  "few_matches", "few_points", "no_consistent_set",
      "not_converged", "poor_fit",    "uncertain",  "no_images"};
};
