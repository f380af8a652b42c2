#include "vision/cameras/cahvore.h"

#include <cmath>

#include "vision/cameras/cahv.h"
#include "vision/cameras/cahvore_angles.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

// A point this much nearer to the axis than to the pupil counts as on it: what is neglected is of
// the square.
constexpr double kOnAxis = 1e-9;

// The lens on its axis, where theta, chi and |lambda| / zeta are the same but for the share.
std::optional<Pixel> ProjectOnAxis(const Cahvore& camera, const Vector3& o, double zeta,
                                   const Vector3& lambda, PixelJacobian* jacobian) {
  const double share = 1.0 + camera.R[0];
  if (!(zeta > 0.0 && share > 0.0)) return std::nullopt;
  PixelJacobian by_bent;
  std::optional<Pixel> pixel =
      MeetPlane(camera.linear, o + share / zeta * lambda, jacobian ? &by_bent : nullptr);
  if (pixel && jacobian != nullptr) {
    *jacobian = share / zeta * (by_bent - by_bent * o * o.transpose());
    *jacobian -= share / (zeta * zeta) * by_bent * lambda * o.transpose();
  }
  return pixel;
}

// The rows of the direction's derivative where the ray is on the axis.
void FillOnAxis(const Eigen::Matrix<double, 3, 2>& slope_by_pixel, double share,
                RayJacobian* jacobian) {
  jacobian->origin.setZero();
  jacobian->direction = slope_by_pixel / share;
}

}  // namespace

double Linearity(const Cahvore& camera) {
  switch (camera.type) {
    case CahvoreType::kPerspective:
      return 1.0;
    case CahvoreType::kFisheye:
      return 0.0;
    case CahvoreType::kGeneral:
      break;
  }
  return camera.general_linearity;
}

std::optional<Pixel> Project(const Cahvore& camera, const Vector3& p_A, PixelJacobian* jacobian) {
  const Vector3 o = camera.O.normalized();
  const Vector3 p = p_A - camera.linear.C;
  const double zeta = p.dot(o);
  const Vector3 lambda = p - zeta * o;
  const double aside = lambda.norm();
  if (aside <= kOnAxis * std::fabs(zeta)) return ProjectOnAxis(camera, o, zeta, lambda, jacobian);

  const double linearity = Linearity(camera);
  const std::optional<SightAngle> sight = SolveTheta(camera.E, zeta, aside);
  if (!sight || !(sight->theta_rad < LargestAngle(linearity))) return std::nullopt;
  const AngleImage image = ImageOfTheta(linearity, sight->theta_rad);
  const RadialPolynomial distortion = DistortionOf(camera.R);
  if (!GrowsUpTo(distortion, image.chi)) return std::nullopt;
  const double distorted = image.chi * Share(distortion, image.chi * image.chi);
  const Vector3 outward = lambda / aside;
  PixelJacobian by_bent;
  std::optional<Pixel> pixel =
      MeetPlane(camera.linear, o + distorted * outward, jacobian ? &by_bent : nullptr);
  if (!pixel || jacobian == nullptr) return pixel;

  // dtheta = (cos(theta) dlambda - sin(theta) dzeta) / reach; d outward = what of dp is across the
  // axis and the outward direction, over lambda.
  const Vector3 theta_by_point =
      (std::cos(sight->theta_rad) * outward - std::sin(sight->theta_rad) * o) / sight->reach_m;
  const Eigen::Matrix3d outward_by_point =
      (Eigen::Matrix3d::Identity() - o * o.transpose() - outward * outward.transpose()) / aside;
  const double distorted_by_theta = Growth(distortion, image.chi) * image.by_theta;
  *jacobian = by_bent * (distorted_by_theta * outward * theta_by_point.transpose() +
                         distorted * outward_by_point);
  return pixel;
}

std::optional<Ray> BackProject(const Cahvore& camera, const Pixel& pixel, RayJacobian* jacobian) {
  Eigen::Matrix<double, 3, 2> bent_by_pixel;
  const std::optional<Vector3> bent =
      LeavePlane(camera.linear, pixel, jacobian ? &bent_by_pixel : nullptr);
  if (!bent) return std::nullopt;
  const Vector3 o = camera.O.normalized();
  const double zeta = bent->dot(o);
  if (!(zeta > 0.0)) return std::nullopt;
  const Vector3 slope = (*bent - zeta * o) / zeta;
  const double distorted = slope.norm();
  const double linearity = Linearity(camera);
  const RadialPolynomial distortion = DistortionOf(camera.R);
  const std::optional<double> chi = Undistort(distortion, distorted);
  const std::optional<double> theta = chi ? ThetaOf(linearity, *chi) : std::nullopt;
  if (!theta) return std::nullopt;

  const bool on_axis = distorted <= kOnAxis;
  const Vector3 outward = on_axis ? Vector3::Zero() : Vector3(slope / distorted);
  const double sine = std::sin(*theta);
  const double cosine = std::cos(*theta);
  const PupilShift shift = ShiftOf(camera.E, *theta);
  std::optional<Ray> ray =
      Finite({camera.linear.C + shift.s_m * o, on_axis ? (o + slope / distortion.c[0]).normalized()
                                                       : Vector3(cosine * o + sine * outward)});
  if (!ray || jacobian == nullptr) return ray;

  const Eigen::RowVector2d zeta_by_pixel = o.transpose() * bent_by_pixel;
  const Eigen::Matrix<double, 3, 2> slope_by_pixel =
      (bent_by_pixel - o * zeta_by_pixel - slope * zeta_by_pixel) / zeta;
  if (on_axis) {
    FillOnAxis(slope_by_pixel, distortion.c[0], jacobian);
    return ray;
  }
  const Eigen::RowVector2d distorted_by_pixel = outward.transpose() * slope_by_pixel;
  const double distorted_by_theta =
      Growth(distortion, *chi) * ImageOfTheta(linearity, *theta).by_theta;
  const Eigen::RowVector2d theta_by_pixel = distorted_by_pixel / distorted_by_theta;
  jacobian->origin = shift.by_theta * o * theta_by_pixel;
  jacobian->direction = (cosine * outward - sine * o) * theta_by_pixel +
                        sine / distorted * (slope_by_pixel - outward * distorted_by_pixel);
  return ray;
}

Cahvore Moved(const math::Transform& X_BA, const Cahvore& camera) {
  Cahvore moved = camera;
  moved.linear = Moved(X_BA, camera.linear);
  moved.O = X_BA.linear() * camera.O;
  return moved;
}

Cahvore Mapped(const Cahvore& camera, const PixelMap& map) {
  Cahvore mapped = camera;
  mapped.linear = Mapped(camera.linear, map);
  return mapped;
}

}  // namespace rockyard::vision
