#include "vision/odometry/plain_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "vision/cameras/camera_model.h"

namespace rockyard::vision {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using math::Transform;

// The motion and one place each, as a vector of changes.
struct Unknowns {
  Transform X_FS;
  std::vector<Vector3d> places_F;
};

Transform Turned(const Transform& X, const Vector3d& by_m, const Vector3d& by_rad) {
  Transform turned = X;
  turned.translation() += by_m;
  const double angle_rad = by_rad.norm();
  if (angle_rad > 0.0) {
    turned.linear() =
        Eigen::AngleAxisd(angle_rad, by_rad / angle_rad).toRotationMatrix() * X.linear();
  }
  return turned;
}

Unknowns Changed(const Unknowns& at, const VectorXd& change) {
  Unknowns changed{Turned(at.X_FS, change.head<3>(), change.segment<3>(3)), at.places_F};
  for (std::size_t i = 0; i < at.places_F.size(); ++i) {
    changed.places_F[i] += change.segment<3>(6 + 3 * static_cast<Eigen::Index>(i));
  }
  return changed;
}

// Of one type, since each other one takes seconds to compile.
MatrixXd Solved(const MatrixXd& N, const MatrixXd& right) { return N.ldlt().solve(right); }

MatrixXd Inverse(const MatrixXd& N) { return Solved(N, MatrixXd::Identity(N.rows(), N.cols())); }

Vector3d Seen(const RectifiedPair& cameras, const Vector3d& p_A) {
  const Pixel left = *Project(cameras.left, p_A);
  const Pixel right = *Project(cameras.right, p_A);
  return {left.x(), left.y(), left.x() - right.x()};
}

// Each residual in units of its own standard deviation.
Vector3d Whitened(const StereoMeasurement& seen, const Vector3d& expected) {
  const Vector3d r = Vector3d(seen.left.x(), seen.left.y(), seen.disparity_px) - expected;
  return seen.covariance_px2.llt().matrixL().solve(r);
}

VectorXd Residuals(const PointsSeenTwice& points, const RectifiedPair& cameras,
                   const Unknowns& at) {
  VectorXd residuals(6 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    residuals.segment<3>(row) = Whitened(points[i].first, Seen(cameras, at.places_F[i]));
    residuals.segment<3>(row + 3) =
        Whitened(points[i].second, Seen(cameras, at.X_FS.inverse() * at.places_F[i]));
  }
  return residuals;
}

}  // namespace

Motion PlainBundle(const PointsSeenTwice& points, const RectifiedPair& cameras,
                   const Transform& start) {
  Unknowns at{start, {}};
  for (const PointSeenTwice& point : points) at.places_F.push_back(point.first.p_A);
  const auto unknowns = 6 + 3 * static_cast<Eigen::Index>(points.size());
  MatrixXd N;
  for (int step = 0; step < 20; ++step) {
    const VectorXd residuals = Residuals(points, cameras, at);
    MatrixXd J(residuals.size(), unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const double h = 1e-6;
      const VectorXd change = h * VectorXd::Unit(unknowns, i);
      J.col(i) = (Residuals(points, cameras, Changed(at, change)) -
                  Residuals(points, cameras, Changed(at, -change))) /
                 (2.0 * h);
    }
    N = J.transpose() * J;
    at = Changed(at, -Solved(N, J.transpose() * residuals));
  }
  return {at.X_FS, Inverse(N).topLeftCorner<6, 6>()};
}

Motion MotionInSpace(const PointsSeenTwice& points, const Transform& start) {
  Transform X_FS = start;
  MotionCovariance N;
  for (int step = 0; step < 10; ++step) {
    N.setZero();
    Eigen::Matrix<double, 6, 1> side = Eigen::Matrix<double, 6, 1>::Zero();
    for (const PointSeenTwice& point : points) {
      const Vector3d turned = X_FS.linear() * point.second.p_A;
      const Vector3d r = turned + X_FS.translation() - point.first.p_A;
      const Eigen::Matrix3d W =
          (point.first.covariance_m2 +
           X_FS.linear() * point.second.covariance_m2 * X_FS.linear().transpose())
              .inverse();
      Eigen::Matrix<double, 3, 6> J;
      J.leftCols<3>().setIdentity();
      for (int axis = 0; axis < 3; ++axis) J.col(3 + axis) = Vector3d::Unit(axis).cross(turned);
      N += J.transpose() * W * J;
      side -= J.transpose() * W * r;
    }
    const VectorXd change = Solved(N, side);
    X_FS = Turned(X_FS, change.head<3>(), change.tail<3>());
  }
  return {X_FS, Inverse(N)};
}

Eigen::Matrix<double, 6, 1> ErrorOf(const Transform& estimated, const Transform& truth) {
  Eigen::Matrix<double, 6, 1> error;
  error.head<3>() = truth.translation() - estimated.translation();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(truth.linear() * estimated.linear().transpose()));
  error.tail<3>() = turn.angle() * turn.axis();
  return error;
}

}  // namespace rockyard::vision
