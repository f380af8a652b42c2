// A pair of cameras and points that it sees twice, with known errors of their pixels.
#pragma once

#include <Eigen/Cholesky>
#include <cstddef>
#include <optional>

#include "core/random.h"
#include "vision/cameras/camera_model.h"
#include "vision/cameras/rectification.h"
#include "vision/odometry/stereo_measurement.h"

namespace rockyard::vision {

// 512 x 384 px over 45 deg, 20 cm apart, in an outer frame A that is not the cameras' own.
inline RectifiedPair OdometryPair() {
  const math::Transform X_AC = math::MakePose({0.3, -0.1, 1.2}, 0.2, -0.5, 0.1);
  constexpr double kFocal_px = 618.0;
  const Cahv left =
      Moved(X_AC, Cahv{{0, 0, 0}, {0, 0, 1}, {kFocal_px, 0, 255.5}, {0, kFocal_px, 191.5}});
  Cahv right = left;
  right.C = X_AC * math::Vector3(0.2, 0.0, 0.0);
  return {left, right, {512, 384}, kFocal_px, 0.2};
}

inline const RectifiedPair kOdometryPair = OdometryPair();

// What the pair sees of a point, without errors. Nothing outside of the left image.
inline std::optional<StereoMeasurement> SeenExactly(const RectifiedPair& pair,
                                                    const math::Vector3& p_A,
                                                    const Eigen::Matrix3d& covariance_px2) {
  const auto left = Project(pair.left, p_A);
  const auto right = Project(pair.right, p_A);
  if (!left || !right || left->minCoeff() < 0.0 || left->x() > pair.size.columns - 1 ||
      left->y() > pair.size.rows - 1) {
    return std::nullopt;
  }
  StereoMeasurement seen{*left, left->x() - right->x(), covariance_px2, p_A, {}};
  const auto point = Triangulate(pair.left, pair.right, seen.left, seen.disparity_px);
  if (!point) return std::nullopt;
  seen.covariance_m2 = point->Covariance(covariance_px2);
  return seen;
}

// The same with a Gaussian error of its covariance. Nothing where its disparity is lost by that.
inline std::optional<StereoMeasurement> SeenWithErrors(const RectifiedPair& pair,
                                                       StereoMeasurement seen,
                                                       core::RandomStream& stream) {
  Eigen::Vector3d normal;
  for (int i = 0; i < 3; ++i) normal(i) = core::SampleNormal(stream, 0.0, 1.0);
  const Eigen::Matrix3d root = seen.covariance_px2.llt().matrixL();
  const Eigen::Vector3d error = root * normal;
  seen.left += error.head<2>();
  seen.disparity_px += error.z();
  const auto point = Triangulate(pair.left, pair.right, seen.left, seen.disparity_px);
  if (!point) return std::nullopt;
  seen.p_A = point->p_A;
  seen.covariance_m2 = point->Covariance(seen.covariance_px2);
  return seen;
}

struct PointField {
  std::size_t points = 100;
  double nearest_m = 2.0;
  double farthest_m = 12.0;
  bool with_errors = true;
  // Of column, row and disparity at either moment.
  Eigen::Matrix3d covariance_px2 = Eigen::Vector3d(0.04, 0.04, 0.0625).asDiagonal();
};

// A point in the left image at the first moment, at a random depth of the field.
inline math::Vector3 RandomPoint(const RectifiedPair& pair, const PointField& field,
                                 core::RandomStream& stream) {
  const Pixel pixel(core::SampleUniform(stream, 0.0, pair.size.columns - 1),
                    core::SampleUniform(stream, 0.0, pair.size.rows - 1));
  const double depth_m = core::SampleUniform(stream, field.nearest_m, field.farthest_m);
  const double disparity_px = pair.focal_px * pair.baseline_m / depth_m;
  return Triangulate(pair.left, pair.right, pixel, disparity_px)->p_A;
}

// Points that both moments see, the cameras having moved by X_FS.
inline PointsSeenTwice SeeTwice(const RectifiedPair& pair, const math::Transform& X_FS,
                                const PointField& field, core::RandomStream& stream) {
  PointsSeenTwice points;
  while (points.size() < field.points) {
    const math::Vector3 p_F = RandomPoint(pair, field, stream);
    auto first = SeenExactly(pair, p_F, field.covariance_px2);
    auto second = SeenExactly(pair, X_FS.inverse() * p_F, field.covariance_px2);
    if (first && second && field.with_errors) {
      first = SeenWithErrors(pair, *first, stream);
      second = SeenWithErrors(pair, *second, stream);
    }
    if (first && second) points.push_back({*first, *second});
  }
  return points;
}

// 40 cm ahead in the frame of OdometryPair with some of everything else.
inline math::Transform TestMotion() {
  return math::MakePose({0.1, -0.05, 0.35}, 0.06, -0.03, 0.04);
}

}  // namespace rockyard::vision
