#include "vision/odometry/motion_estimate.h"

namespace rockyard::vision {
namespace {

Eigen::Matrix3d CrossMatrix(const math::Vector3& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

}  // namespace

Motion Compose(const Motion& A_to_B, const Motion& B_to_C) {
  const Eigen::Matrix3d R_AB = A_to_B.X_FS.linear();
  MotionCovariance by_first = MotionCovariance::Identity();
  by_first.topRightCorner<3, 3>() = -CrossMatrix(R_AB * B_to_C.X_FS.translation());
  MotionCovariance by_second = MotionCovariance::Zero();
  by_second.topLeftCorner<3, 3>() = R_AB;
  by_second.bottomRightCorner<3, 3>() = R_AB;
  Motion whole;
  whole.X_FS = A_to_B.X_FS * B_to_C.X_FS;
  whole.covariance = by_first * A_to_B.covariance * by_first.transpose() +
                     by_second * B_to_C.covariance * by_second.transpose();
  return whole;
}

}  // namespace rockyard::vision
