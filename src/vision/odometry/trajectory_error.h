// How far an estimated path lies from the true one, in published measures. For `rockyard vo`, which
// judges a path when it is done; no drive depends on it. Must stay: the published definitions, by
// which paths are compared with those of other programs.
//
// A path is the pose X_AB of one body B at successive moments, in a frame A of its own; the two
// paths may have different frames, but their body is the same.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "math/pose.h"
#include "vision/odometry/estimate_motion.h"

namespace rockyard::vision {

using Trajectory = std::vector<math::Transform>;

// The lengths of the KITTI odometry benchmark (Geiger, Lenz and Urtasun 2012, section 3), m.
inline constexpr std::array<double, 8> kKittiLengths_m{100.0, 200.0, 300.0, 400.0,
                                                       500.0, 600.0, 700.0, 800.0};
// A segment of that benchmark begins every so many poses.
inline constexpr std::int64_t kKittiStride = 10;

// The error over one part of the path that is at least `length_m` long.
struct SegmentError {
  std::int64_t first = 0;  // indices of its first and last pose
  std::int64_t last = 0;
  double length_m = 0.0;            // as requested
  double translation = 0.0;         // |e_t| / length, without unit
  double rotation_rad_per_m = 0.0;  // |e_r| / length
};

// Returns the errors of relative motion over segments of each length, from every `stride`th pose:
//   (E_first^-1 E_last)^-1 (T_first^-1 T_last),   e_t, e_r its translation and its angle,
// T the true and E the estimated poses. A segment ends at the first pose from which the true path
// back to its beginning is longer than its length (Geiger, Lenz and Urtasun 2012 and their
// evaluation program). The result is empty where the path is too short. Requires paths of equal
// size, lengths > 0, stride >= 1.
std::vector<SegmentError> SegmentErrors(const Trajectory& truth, const Trajectory& estimate,
                                        std::span<const double> lengths_m = kKittiLengths_m,
                                        std::int64_t stride = kKittiStride);

// The means over all segments, each counting once; MeanOf returns nothing without a segment.
struct MeanSegmentError {
  std::int64_t segments = 0;
  double translation = 0.0;
  double rotation_rad_per_m = 0.0;
};
std::optional<MeanSegmentError> MeanOf(std::span<const SegmentError> segments);

// How the frame of an estimate is brought to that of the truth.
enum class Alignment {
  kFirstPose,  // first poses are made equal
  kRigid,      // least squares over all positions
};

// Returns the transform X_TE from the frame E of the estimate to the frame T of the truth. kRigid
// minimizes sum |t_i - X_TE e_i|^2 over rotations and translations (Umeyama 1991 without scale;
// Sturm et al. 2012, section II); where positions leave the rotation open (fewer than three, or all
// on a line), it returns one of the best. Requires paths of equal size, not empty.
math::Transform AlignmentOf(const Trajectory& truth, const Trajectory& estimate,
                            Alignment alignment);

// A summary of distances or angles.
struct ErrorSummary {
  std::int64_t count = 0;
  double rms = 0.0;
  double mean = 0.0;
  double median = 0.0;  // for an even number the mean of the middle two
  double largest = 0.0;
};
// Returns nothing without values.
std::optional<ErrorSummary> SummaryOf(std::vector<double> values);

// Returns the absolute trajectory errors: distances |t_i - X_TE e_i|, m, one for each pose (Sturm
// et al. 2012, section II, "A Benchmark for the Evaluation of RGB-D SLAM Systems").
std::vector<double> AbsoluteErrors_m(const Trajectory& truth, const Trajectory& estimate,
                                     Alignment alignment);

// Relative pose errors over `delta` steps: translation, m, and angle, rad, of
// (T_i^-1 T_i+delta)^-1 (E_i^-1 E_i+delta), one for each i (Sturm et al. 2012, section II).
// Requires delta >= 1; empty where the path has no more than delta poses.
struct RelativeErrors {
  std::vector<double> translation_m;
  std::vector<double> rotation_rad;
};
RelativeErrors RelativeErrorsOf(const Trajectory& truth, const Trajectory& estimate,
                                std::int64_t delta);

// Returns e' C^-1 e of a motion's error e = (e_t, e_r) against the true motion, with C its
// covariance (MotionCovariance): chi-squared with 6 degrees of freedom where the covariance is
// right. Requires a covariance that can be inverted.
double NormalizedErrorSquared(const Motion& estimated, const math::Transform& true_X_FS);

// Returns the way along the polygon through the positions up to each pose, m; 0 at the first.
std::vector<double> DistancesAlong(const Trajectory& path);

// Returns the angle of a rotation, rad, 0 to pi.
double AngleOf(const Eigen::Matrix3d& rotation);

}  // namespace rockyard::vision
