/// @file
/// Rigid transforms in monogram notation, for all modules: X_AB is the pose of frame B in frame A,
/// so that p_A = X_AB * p_B. World W: x along the course, y left, z up. Rover R: x forward, y left,
/// z up, origin on the ground under the chassis centre. Must stay: axes, signs and the order of
/// operations, as the bits of all records depend on them.
#pragma once

#include <Eigen/Geometry>

#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::math {

/// A vector or a point, m where it is a place, and a rigid transform, both in double precision.
using Vector3 = Eigen::Vector3d;
using Transform = Eigen::Isometry3d;

/// A pose in the ground plane of W.
struct Pose2 {
  double x_m = 0.0;          ///< along the course
  double y_m = 0.0;          ///< to the left of the course
  double heading_rad = 0.0;  ///< from +x towards +y
};

/// Returns the rotation by an angle about a unit axis (Rodrigues). Eigen's AngleAxis calls the C
/// library, whose bits depend on the processor.
inline Eigen::Matrix3d RotationAbout(double angle_rad, const Vector3& axis) {
  const auto [s, c] = SinCos(angle_rad);
  const Vector3 rest = (1.0 - c) * axis;
  const Vector3 sine = s * axis;
  Eigen::Matrix3d R;
  R.row(0) << rest.x() * axis.x() + c, rest.x() * axis.y() - sine.z(),
      rest.x() * axis.z() + sine.y();
  R.row(1) << rest.x() * axis.y() + sine.z(), rest.y() * axis.y() + c,
      rest.y() * axis.z() - sine.x();
  R.row(2) << rest.x() * axis.z() - sine.y(), rest.y() * axis.z() + sine.x(),
      rest.z() * axis.z() + c;
  return R;
}

/// A rotation by an angle in [0, pi] about a unit axis.
struct Turn {
  double angle_rad = 0.0;
  Vector3 axis = Vector3::UnitX();

  /// Returns the axis times the angle, rad.
  Vector3 Vector_rad() const { return angle_rad * axis; }
};

/// Returns the turn of a rotation matrix, by its quaternion, exact near 0 and near pi.
inline Turn TurnOf(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double size = q.vec().norm();
  if (size == 0.0) return {};
  return {2.0 * Atan2(size, std::abs(q.w())), q.vec() / (q.w() < 0.0 ? -size : size)};
}

/// Returns the heading of X_WR, rad: the direction of the rover's x axis projected on the ground.
inline double Heading(const Transform& X_WR) {
  const Vector3 forward = X_WR.linear().col(0);
  return Atan2(forward.y(), forward.x());
}

/// Returns the angle between the rover's z axis and the world's, rad.
inline double Tilt(const Transform& X_WR) {
  return Acos(std::fmin(1.0, std::fmax(-1.0, X_WR.linear()(2, 2))));
}

/// Returns the place and the heading of X_WR; height and tilt are left out.
inline Pose2 ToPose2(const Transform& X_WR) {
  return {X_WR.translation().x(), X_WR.translation().y(), Heading(X_WR)};
}

/// Returns X_AC = X_AB X_BC: p_A = p_AB + Rz(heading) p_B.
inline Pose2 operator*(const Pose2& X_AB, const Pose2& X_BC) {
  const auto [s, c] = SinCos(X_AB.heading_rad);
  return {X_AB.x_m + c * X_BC.x_m - s * X_BC.y_m, X_AB.y_m + s * X_BC.x_m + c * X_BC.y_m,
          WrapAngle(X_AB.heading_rad + X_BC.heading_rad)};
}

/// Returns X_BC = (X_AB)^-1 X_AC: where C lies as seen from B.
inline Pose2 SeenFrom(const Pose2& X_AB, const Pose2& X_AC) {
  const auto [s, c] = SinCos(X_AB.heading_rad);
  const double dx_m = X_AC.x_m - X_AB.x_m;
  const double dy_m = X_AC.y_m - X_AB.y_m;
  return {c * dx_m + s * dy_m, -s * dx_m + c * dy_m,
          WrapAngle(X_AC.heading_rad - X_AB.heading_rad)};
}

/// Returns X_AL = X_AR (X_BR)^-1 X_BL: where L lies in A, if R and L are known in B and R in A. L
/// keeps its place beside R, so that it is carried along where R jumps from X_BR to X_AR.
inline Pose2 Carried(const Pose2& X_AR, const Pose2& X_BR, const Pose2& X_BL) {
  const double turn_rad = X_AR.heading_rad - X_BR.heading_rad;
  const auto [s, c] = SinCos(turn_rad);
  const double dx_m = X_BL.x_m - X_BR.x_m;
  const double dy_m = X_BL.y_m - X_BR.y_m;
  return {X_AR.x_m + c * dx_m - s * dy_m, X_AR.y_m + s * dx_m + c * dy_m,
          WrapAngle(X_BL.heading_rad + turn_rad)};
}

/// Returns the pose turned about a place by `angle_rad`, positive from +x towards +y. An angle of 0
/// must leave the pose bit for bit as it is: a believed pan angle of 0 changes no drive.
inline Pose2 TurnedAbout(const Pose2& pose, double x_m, double y_m, double angle_rad) {
  if (angle_rad == 0.0) return pose;
  return Carried({x_m, y_m, angle_rad}, {x_m, y_m, 0.0}, pose);
}

/// Returns the pose of R at p_WoRo_W with the given attitude: heading about z, then pitch about y
/// (positive: nose down), then roll about x (positive: left side up), R_WR = Rz(heading) Ry(pitch)
/// Rx(roll).
inline Transform MakePose(const Vector3& p_WoRo_W, double heading_rad, double pitch_rad,
                          double roll_rad) {
  Transform X_WR = Transform::Identity();
  const auto [sh, ch] = SinCos(heading_rad);
  const auto [sp, cp] = SinCos(pitch_rad);
  const auto [sr, cr] = SinCos(roll_rad);
  auto R_WR = X_WR.linear();
  R_WR.row(0) << ch * cp, ch * sp * sr - sh * cr, ch * sp * cr + sh * sr;
  R_WR.row(1) << sh * cp, sh * sp * sr + ch * cr, sh * sp * cr - ch * sr;
  R_WR.row(2) << -sp, cp * sr, cp * cr;
  X_WR.translation() = p_WoRo_W;
  return X_WR;
}

}  // namespace rockyard::math
