#include "vision/odometry/rigid_motion.h"

#include <Eigen/SVD>

#include "core/check.h"

namespace rockyard::vision {
namespace {

math::Vector3 MeanOf(std::span<const math::Vector3> points) {
  math::Vector3 sum = math::Vector3::Zero();
  for (const math::Vector3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::optional<math::Transform> RigidMotion(std::span<const math::Vector3> points_F,
                                           std::span<const math::Vector3> points_S) {
  EXPECT(points_F.size() == points_S.size());
  if (points_F.size() < 3) return std::nullopt;
  const math::Vector3 middle_F = MeanOf(points_F);
  const math::Vector3 middle_S = MeanOf(points_S);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points_F.size(); ++i) {
    moments += (points_F[i] - middle_F) * (points_S[i] - middle_S).transpose();
  }
  if (!moments.allFinite()) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
  constexpr double kFlat = 1e-12;  // of squares
  if (!(svd.singularValues()[1] > kFlat * svd.singularValues()[0])) return std::nullopt;
  math::Vector3 sign = math::Vector3::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  math::Transform X_FS = math::Transform::Identity();
  X_FS.linear() = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  X_FS.translation() = middle_F - X_FS.linear() * middle_S;
  return X_FS;
}

}  // namespace rockyard::vision
