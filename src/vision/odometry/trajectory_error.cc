#include "vision/odometry/trajectory_error.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/check.h"
#include "math/decompositions.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

const Transform& PoseAt(const Trajectory& path, std::int64_t index) {
  return path[static_cast<std::size_t>(index)];
}

// Returns the motion from one pose of a path to another, told in the body frame of the first.
Transform Between(const Trajectory& path, std::int64_t first, std::int64_t last) {
  return PoseAt(path, first).inverse() * PoseAt(path, last);
}

Vector3 MeanPosition(const Trajectory& path) {
  Vector3 sum = Vector3::Zero();
  for (const Transform& pose : path) sum += pose.translation();
  return sum / static_cast<double>(path.size());
}

// Returns Alignment::kRigid: with the cross-covariance S = sum (t - mean t) (e - mean e)^T =
// U D V^T the best rotation is U diag(1, 1, det(U) det(V)) V^T (Umeyama 1991, equations 40 to 43).
Transform RigidAlignment(const Trajectory& truth, const Trajectory& estimate) {
  const Vector3 mean_truth = MeanPosition(truth);
  const Vector3 mean_estimate = MeanPosition(estimate);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    covariance += (truth[i].translation() - mean_truth) *
                  (estimate[i].translation() - mean_estimate).transpose();
  }
  const math::SingularValues svd = math::SingularValuesOf(covariance);
  Vector3 signs = Vector3::Ones();
  signs.z() = svd.U.determinant() * svd.V.determinant() < 0.0 ? -1.0 : 1.0;
  Transform X_TE = Transform::Identity();
  X_TE.linear() = svd.U * signs.asDiagonal() * svd.V.transpose();
  X_TE.translation() = mean_truth - X_TE.linear() * mean_estimate;
  return X_TE;
}

}  // namespace

double AngleOf(const Eigen::Matrix3d& rotation) {
  // The arc cosine of the trace would lose half of the digits near 0 and near pi.
  return math::TurnOf(rotation).angle_rad;
}

std::vector<double> DistancesAlong(const Trajectory& path) {
  std::vector<double> distances_m(path.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    distances_m[i] =
        distances_m[i - 1] + (path[i].translation() - path[i - 1].translation()).norm();
  }
  return distances_m;
}

std::vector<SegmentError> SegmentErrors(const Trajectory& truth, const Trajectory& estimate,
                                        std::span<const double> lengths_m, std::int64_t stride) {
  EXPECT(truth.size() == estimate.size() && stride >= 1);
  const std::vector<double> along_m = DistancesAlong(truth);
  std::vector<SegmentError> segments;
  for (std::int64_t first = 0; first < std::ssize(truth); first += stride) {
    for (const double length_m : lengths_m) {
      EXPECT(length_m > 0.0);
      const double end_m = along_m[static_cast<std::size_t>(first)] + length_m;
      const auto end = std::upper_bound(along_m.begin(), along_m.end(), end_m);
      if (end == along_m.end()) continue;
      const std::int64_t last = end - along_m.begin();
      const Transform error =
          Between(estimate, first, last).inverse() * Between(truth, first, last);
      segments.push_back({first, last, length_m, error.translation().norm() / length_m,
                          AngleOf(error.linear()) / length_m});
    }
  }
  return segments;
}

std::optional<MeanSegmentError> MeanOf(std::span<const SegmentError> segments) {
  if (segments.empty()) return std::nullopt;
  MeanSegmentError mean;
  mean.segments = std::ssize(segments);
  for (const SegmentError& segment : segments) {
    mean.translation += segment.translation;
    mean.rotation_rad_per_m += segment.rotation_rad_per_m;
  }
  mean.translation /= static_cast<double>(mean.segments);
  mean.rotation_rad_per_m /= static_cast<double>(mean.segments);
  return mean;
}

Transform AlignmentOf(const Trajectory& truth, const Trajectory& estimate, Alignment alignment) {
  EXPECT(truth.size() == estimate.size() && !truth.empty());
  if (alignment == Alignment::kRigid) return RigidAlignment(truth, estimate);
  return truth.front() * estimate.front().inverse();
}

std::optional<ErrorSummary> SummaryOf(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  const std::size_t middle = values.size() / 2;
  ErrorSummary summary;
  summary.count = std::ssize(values);
  summary.rms =
      std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / count);
  summary.mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  summary.median =
      values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  summary.largest = values.back();
  return summary;
}

std::vector<double> AbsoluteErrors_m(const Trajectory& truth, const Trajectory& estimate,
                                     Alignment alignment) {
  const Transform X_TE = AlignmentOf(truth, estimate, alignment);
  std::vector<double> errors_m;
  errors_m.reserve(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    errors_m.push_back((truth[i].translation() - X_TE * estimate[i].translation()).norm());
  }
  return errors_m;
}

RelativeErrors RelativeErrorsOf(const Trajectory& truth, const Trajectory& estimate,
                                std::int64_t delta) {
  EXPECT(truth.size() == estimate.size() && delta >= 1);
  RelativeErrors errors;
  for (std::int64_t i = 0; i + delta < std::ssize(truth); ++i) {
    const Transform error =
        Between(truth, i, i + delta).inverse() * Between(estimate, i, i + delta);
    errors.translation_m.push_back(error.translation().norm());
    errors.rotation_rad.push_back(AngleOf(error.linear()));
  }
  return errors;
}

double NormalizedErrorSquared(const Motion& estimated, const Transform& true_X_FS) {
  math::Vector6 error;
  error << true_X_FS.translation() - estimated.X_FS.translation(),
      math::TurnOf(true_X_FS.linear() * estimated.X_FS.linear().transpose()).Vector_rad();
  return error.dot(math::SolveSymmetric(estimated.covariance, error));
}

}  // namespace rockyard::vision
