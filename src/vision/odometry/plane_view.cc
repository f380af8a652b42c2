#include "vision/odometry/plane_view.h"

#include <Eigen/LU>

namespace rockyard::vision {

PlaneView::PlaneView(const RectifiedPair& pair, const math::Transform& X_SF) {
  Eigen::Matrix3d M;
  M << pair.left.H.transpose(), pair.left.V.transpose(), pair.left.A.transpose();
  turn_ = M * X_SF.linear() * M.inverse();
  shift_ = M * (X_SF * pair.left.C - pair.left.C) / pair.left.H.dot(pair.right.C - pair.left.C);
}

std::optional<PredictedFeature> PlaneView::operator()(const StereoMeasurement& measured) const {
  constexpr double kLeastDepthShare = 1e-6;  // the second depth over the first
  constexpr double kMostSlope = 0.75;        // must be the bound of PlacementParams::max_slope
  constexpr double kMostChange = 8.0;
  const Pixel& p = measured.left;
  Eigen::Vector3d plane;
  plane << measured.slope, measured.disparity_px - measured.slope.dot(p);
  const Eigen::Matrix3d H = turn_ + shift_ * plane.transpose();
  const Eigen::Vector3d second = H * p.homogeneous();
  if (!(second.z() > kLeastDepthShare)) return std::nullopt;
  const Eigen::Matrix3d G = H.inverse();
  PredictedFeature seen;
  seen.pixel = second.hnormalized();
  const double scale = 1.0 / second.z();
  seen.view.by_distance = G.row(2).head<2>().transpose() / scale;
  seen.view.by_offset = G.topLeftCorner<2, 2>() / scale - p * seen.view.by_distance.transpose();
  seen.slope = (G.transpose() * plane).head<2>();
  // The comparisons are written so that numbers that are not finite fail.
  if (!(seen.slope.cwiseAbs().maxCoeff() <= kMostSlope)) return std::nullopt;
  if (!(seen.view.by_offset.cwiseAbs().maxCoeff() <= kMostChange)) return std::nullopt;
  return seen;
}

}  // namespace rockyard::vision
