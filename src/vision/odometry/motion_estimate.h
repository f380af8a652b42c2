// A motion of a pair of cameras between two moments, or why there is none.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/fields.h"
#include "math/pose.h"

namespace rockyard::vision {

// Covariance of a motion: of (translation, rotation vector), m and rad, both told in the first
// frame F: R = exp([e_r]x) R_estimated, p = p_estimated + e_t.
using MotionCovariance = Eigen::Matrix<double, 6, 6>;

struct Motion {
  // F and S are the outer frame of the cameras at the first and the second moment, p_F = X_FS p_S.
  math::Transform X_FS = math::Transform::Identity();
  MotionCovariance covariance = MotionCovariance::Zero();
};

// Why there is no motion.
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

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::NoMotion> {
  static constexpr std::array<std::string_view, 8> kNames{
      "few_features",  "few_matches", "few_points", "no_consistent_set",
      "not_converged", "poor_fit",    "uncertain",  "no_images"};
};
