#include "vision/odometry/rigid_motion.h"

#include "core/check.h"
#include "math/decompositions.h"

namespace rockyard::vision {
namespace {

double WeightOf(std::span<const double> weights, std::size_t i) {
  return weights.empty() ? 1.0 : weights[i];
}

math::Vector3 MeanOf(std::span<const math::Vector3> points, std::span<const double> weights) {
  math::Vector3 sum = math::Vector3::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += WeightOf(weights, i) * points[i];
    weight += WeightOf(weights, i);
  }
  return sum / weight;
}

}  // namespace

std::optional<math::Transform> RigidMotion(std::span<const math::Vector3> points_F,
                                           std::span<const math::Vector3> points_S,
                                           std::span<const double> weights) {
  EXPECT(points_F.size() == points_S.size());
  EXPECT(weights.empty() || weights.size() == points_F.size());
  if (points_F.size() < 3) return std::nullopt;
  const math::Vector3 middle_F = MeanOf(points_F, weights);
  const math::Vector3 middle_S = MeanOf(points_S, weights);
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points_F.size(); ++i) {
    moments +=
        WeightOf(weights, i) * (points_F[i] - middle_F) * (points_S[i] - middle_S).transpose();
  }
  if (!moments.allFinite()) return std::nullopt;
  const math::SingularValues svd = math::SingularValuesOf(moments);
  constexpr double kFlat = 1e-12;  // of squares
  if (!(svd.values[1] > kFlat * svd.values[0])) return std::nullopt;
  math::Vector3 sign = math::Vector3::Ones();
  if (svd.U.determinant() * svd.V.determinant() < 0.0) sign.z() = -1.0;
  math::Transform X_FS = math::Transform::Identity();
  X_FS.linear() = svd.U * sign.asDiagonal() * svd.V.transpose();
  X_FS.translation() = middle_F - X_FS.linear() * middle_S;
  return X_FS;
}

}  // namespace rockyard::vision
