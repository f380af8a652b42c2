// A motion of a pair of cameras between two moments, or why there is none.
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

// Covariance of a motion: of (translation, rotation vector), m and rad, both told in the first
// frame F: R = exp([e_r]x) R_estimated, p = p_estimated + e_t.
using MotionCovariance = Eigen::Matrix<double, 6, 6>;

struct Motion {
  // F and S are the outer frame of the cameras at the first and the second moment, p_F = X_FS p_S.
  math::Transform X_FS = math::Transform::Identity();
  MotionCovariance covariance = MotionCovariance::Zero();
};

// Why there is no motion. Only appended to: journals of `rockyard vo` hold the number, results the
// name.
enum class NoMotion {
  kFewFeatures,      // an image has too few corners
  kFewMatches,       // too few of them look alike
  kFewPoints,        // too few have a place, seen by both eyes
  kNoConsistentSet,  // too few of these moved as one rigid body
  kNotConverged,     // least squares did not end
  kPoorFit,          // what is left over is more than the measurements' noise explains
  kUncertain,        // the covariance is larger than what is asked for
  kNoImages,         // nobody could read them; for the odometer there is no such pair
};

struct MotionCounts {
  std::int64_t features_first = 0;  // of the left images
  std::int64_t features_second = 0;
  std::int64_t matches = 0;     // between the two left images
  std::int64_t points = 0;      // of these, with a place at both moments
  std::int64_t consistent = 0;  // of these, moved as one
  std::int64_t iterations = 0;  // of least squares
};

// What came out of two pairs of images.
struct MotionResult {
  std::optional<Motion> motion;
  std::optional<NoMotion> reason;  // exactly where there is no motion
  MotionCounts counts;
  double rms_px = 0.0;  // root mean square residual of the consistent set; 0 without one
};

// From A to C by way of B, the errors of both parts being independent and small. With the errors
// of MotionCovariance, each told in the first frame of its part,
//   e_r = e_rAB + R_AB e_rBC        e_t = e_tAB + R_AB e_tBC - [R_AB p_BC]x e_rAB,
// so that the covariance is J_AB C_AB J_AB' + J_BC C_BC J_BC', told in A.
Motion Compose(const Motion& A_to_B, const Motion& B_to_C);

// The most likely motion of a pair of cameras that saw the same points twice.

struct EstimatedMotion {
  std::optional<Motion> motion;
  std::optional<NoMotion> reason;  // exactly where there is no motion
  // Where least squares ended, and whether by themselves; of no worth without a motion but as where
  // to begin.
  math::Transform X_FS = math::Transform::Identity();
  bool converged = false;
  std::int64_t iterations = 0;
  double fit = 0.0;     // chi-squared over degrees of freedom: 1 where the noise is as stated
  double rms_px = 0.0;  // of columns, rows and disparities
};

// Least squares from `start`. Unknown are the motion and where the points are; both moments'
// measurements m = (column, row, disparity) of every point count by their covariances:
//
//   minimize sum_i |m_Fi - h(p_i)|^2_(S_Fi) + |m_Si - h(X_SF p_i)|^2_(S_Si)
//
// h of PairProjection, |r|^2_S = r' S^-1 r. It is the maximum likelihood of normal noise in the
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

template <>
struct rockyard::core::EnumNames<rockyard::vision::NoMotion> {
  static constexpr std::array<std::string_view, 8> kNames{
      "few_features",  "few_matches", "few_points", "no_consistent_set",
      "not_converged", "poor_fit",    "uncertain",  "no_images"};
};
