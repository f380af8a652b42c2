#include "vision/cameras/cahvor.h"

#include <cmath>

#include "vision/cameras/cahv.h"

namespace rockyard::vision {

using math::Vector3;

std::optional<Pixel> Project(const Cahvor& camera, const Vector3& p_A, PixelJacobian* jacobian) {
  const Vector3 o = camera.O.normalized();
  const Vector3 p = p_A - camera.linear.C;
  const double zeta = p.dot(o);
  if (!(zeta > 0.0)) return std::nullopt;
  const Vector3 lambda = p - zeta * o;
  const double tau = lambda.squaredNorm() / (zeta * zeta);
  const RadialPolynomial distortion = DistortionOf(camera.R);
  if (!GrowsUpTo(distortion, std::sqrt(tau))) return std::nullopt;
  const double share = Share(distortion, tau);
  PixelJacobian by_bent;
  std::optional<Pixel> pixel =
      MeetPlane(camera.linear, zeta * o + share * lambda, jacobian ? &by_bent : nullptr);
  if (!pixel || jacobian == nullptr) return pixel;
  // dzeta = O . dp, dlambda = (I - O O^T) dp, dtau = 2 (lambda - tau zeta O) . dp / zeta^2.
  const Vector3 share_by_point =
      ShareSlope(distortion, tau) * 2.0 * (lambda - tau * zeta * o) / (zeta * zeta);
  Eigen::Matrix3d bent_by_point = share * Eigen::Matrix3d::Identity();
  bent_by_point += (1.0 - share) * o * o.transpose() + lambda * share_by_point.transpose();
  *jacobian = by_bent * bent_by_point;
  return pixel;
}

std::optional<Ray> BackProject(const Cahvor& camera, const Pixel& pixel, RayJacobian* jacobian) {
  const std::optional<Vector3> bent = LeavePlane(camera.linear, pixel, nullptr);
  if (!bent) return std::nullopt;
  const Vector3 o = camera.O.normalized();
  const double zeta = bent->dot(o);
  if (!(zeta > 0.0)) return std::nullopt;
  // The slope across the axis, distorted and not: chi' = chi (1 + R0 + R1 chi^2 + R2 chi^4).
  const Vector3 slope = (*bent - zeta * o) / zeta;
  const RadialPolynomial distortion = DistortionOf(camera.R);
  const std::optional<double> chi = Undistort(distortion, slope.norm());
  if (!chi) return std::nullopt;
  const Vector3 direction = (o + slope / Share(distortion, *chi * *chi)).normalized();
  std::optional<Ray> ray = Finite({camera.linear.C, direction});
  if (ray && jacobian != nullptr) {
    PixelJacobian by_point;
    if (!Project(camera, camera.linear.C + direction, &by_point)) return std::nullopt;
    jacobian->origin.setZero();
    jacobian->direction = DirectionByPixel(by_point);
  }
  return ray;
}

Cahvor Moved(const math::Transform& X_BA, const Cahvor& camera) {
  return {Moved(X_BA, camera.linear), X_BA.linear() * camera.O, camera.R};
}

Cahvor Mapped(const Cahvor& camera, const PixelMap& map) {
  return {Mapped(camera.linear, map), camera.O, camera.R};
}

}  // namespace rockyard::vision
