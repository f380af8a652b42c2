#include "vision/cameras/cahv.h"

#include <cmath>
#include <numbers>

#include "math/functions.h"

namespace rockyard::vision {

using math::Vector3;

std::optional<Pixel> Project(const Cahv& camera, const Vector3& p_A, PixelJacobian* jacobian) {
  return MeetPlane(camera, p_A - camera.C, jacobian);
}

std::optional<Ray> BackProject(const Cahv& camera, const Pixel& pixel, RayJacobian* jacobian) {
  Eigen::Matrix<double, 3, 2> by_pixel;
  const std::optional<Vector3> d = LeavePlane(camera, pixel, jacobian ? &by_pixel : nullptr);
  if (!d) return std::nullopt;
  const double length = d->norm();
  const Vector3 direction = *d / length;
  std::optional<Ray> ray = Finite({camera.C, direction});
  if (ray && jacobian != nullptr) {
    jacobian->origin.setZero();
    // The derivative of d / |d| is that of d, across the direction, over |d|.
    jacobian->direction = (by_pixel - direction * (direction.transpose() * by_pixel)) / length;
  }
  return ray;
}

Cahv Moved(const math::Transform& X_BA, const Cahv& camera) {
  return {X_BA * camera.C, X_BA.linear() * camera.A, X_BA.linear() * camera.H,
          X_BA.linear() * camera.V};
}

Cahv Mapped(const Cahv& camera, const PixelMap& map) {
  return {camera.C, camera.A, map.scale * camera.H + map.shift.x() * camera.A,
          map.scale * camera.V + map.shift.y() * camera.A};
}

std::optional<Pixel> MeetPlane(const Cahv& camera, const Vector3& d, PixelJacobian* by_direction) {
  const double depth = d.dot(camera.A);
  if (!(depth > 0.0)) return std::nullopt;
  const Pixel pixel(d.dot(camera.H) / depth, d.dot(camera.V) / depth);
  if (!pixel.allFinite()) return std::nullopt;
  if (by_direction != nullptr) {
    // The quotient rule: d(h / a) = (dh - (h / a) da) / a.
    by_direction->row(0) = (camera.H - pixel.x() * camera.A).transpose() / depth;
    by_direction->row(1) = (camera.V - pixel.y() * camera.A).transpose() / depth;
  }
  return pixel;
}

std::optional<Vector3> LeavePlane(const Cahv& camera, const Pixel& pixel,
                                  Eigen::Matrix<double, 3, 2>* by_pixel) {
  // The columns of the inverse of the matrix with the rows H, V, A.
  const Vector3 by_column = camera.V.cross(camera.A);
  const Vector3 by_row = camera.A.cross(camera.H);
  const Vector3 by_depth = camera.H.cross(camera.V);
  const double volume = by_depth.dot(camera.A);
  const Vector3 d = (pixel.x() * by_column + pixel.y() * by_row + by_depth) / volume;
  if (!d.allFinite()) return std::nullopt;
  if (by_pixel != nullptr) {
    by_pixel->col(0) = by_column / volume;
    by_pixel->col(1) = by_row / volume;
  }
  return d;
}

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

namespace {

using math::Vector3;

// A point whose distance from the axis is at most this share of zeta counts as on the axis. The
// error is of the order of the square.
constexpr double kOnAxis = 1e-9;

// Projects a point on the axis, where theta, chi and |lambda| / zeta are equal and only the
// distortion's share 1 + R0 is left.
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

// Fills in the derivatives of a ray on the axis.
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

  // dtheta = (cos(theta) dlambda - sin(theta) dzeta) / reach. d outward is the part of dp across
  // both the axis and the outward direction, over |lambda|.
  const Vector3 theta_by_point =
      (math::Cos(sight->theta_rad) * outward - math::Sin(sight->theta_rad) * o) / sight->reach_m;
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
  const auto [sine, cosine] = math::SinCos(*theta);
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

namespace {

constexpr int kMostThetaSteps = 30;
constexpr double kThetaTolerance_rad = 1e-14;
// Below this angle the first terms of series replace the formulas with sines; their relative error
// is of the order of theta^2.
constexpr double kSmallAngle_rad = 1e-4;

struct PupilPolynomial {
  double value_m = 0.0;  // E0 + E1 theta^2 + E2 theta^4
  double by_theta_m = 0.0;
};

PupilPolynomial PupilAt(const math::Vector3& E, double theta) {
  const double t = theta * theta;
  return {E[0] + t * (E[1] + t * E[2]), theta * (2.0 * E[1] + t * 4.0 * E[2])};
}

// theta - sin(theta), without the cancellation at small angles.
double ThetaMinusSine(double theta) {
  if (theta < kSmallAngle_rad) return theta * theta * theta / 6.0;
  return theta - math::Sin(theta);
}

}  // namespace

double LargestAngle(double linearity) {
  return std::fmin(std::numbers::pi, 0.5 * std::numbers::pi / std::fabs(linearity));
}

AngleImage ImageOfTheta(double linearity, double theta_rad) {
  const double angle = linearity * theta_rad;
  if (linearity < 0.0) return {math::Sin(angle) / linearity, math::Cos(angle)};
  if (linearity > 0.0) {
    const double tangent = math::Tan(angle);
    return {tangent / linearity, 1.0 + tangent * tangent};
  }
  return {theta_rad, 1.0};
}

std::optional<double> ThetaOf(double linearity, double chi) {
  double theta = chi;
  if (linearity < 0.0) theta = math::Asin(linearity * chi) / linearity;
  if (linearity > 0.0) theta = math::Atan(linearity * chi) / linearity;
  if (!(theta < LargestAngle(linearity))) return std::nullopt;
  return theta;
}

PupilShift ShiftOf(const math::Vector3& E, double theta_rad) {
  const PupilPolynomial pupil = PupilAt(E, theta_rad);
  if (theta_rad < kSmallAngle_rad) {
    // theta / sin(theta) - 1 = theta^2 / 6 + ...
    const double excess = theta_rad * theta_rad / 6.0;
    return {excess * pupil.value_m, theta_rad / 3.0 * pupil.value_m + excess * pupil.by_theta_m};
  }
  const double sine = math::Sin(theta_rad);
  const double excess = theta_rad / sine - 1.0;
  const double excess_by_theta = (sine - theta_rad * math::Cos(theta_rad)) / (sine * sine);
  return {excess * pupil.value_m, excess_by_theta * pupil.value_m + excess * pupil.by_theta_m};
}

std::optional<SightAngle> SolveTheta(const math::Vector3& E, double zeta_m, double lambda_m) {
  double theta = math::Atan2(lambda_m, zeta_m);
  for (int step = 0; step < kMostThetaSteps; ++step) {
    const auto [sine, cosine] = math::SinCos(theta);
    const PupilPolynomial pupil = PupilAt(E, theta);
    const double lag = ThetaMinusSine(theta);
    const double residual_m = zeta_m * sine - lambda_m * cosine - lag * pupil.value_m;
    const double reach_m =
        zeta_m * cosine + lambda_m * sine - (1.0 - cosine) * pupil.value_m - lag * pupil.by_theta_m;
    const double change = residual_m / reach_m;
    theta -= change;
    if (!(theta >= 0.0 && theta < std::numbers::pi)) return std::nullopt;
    if (std::fabs(change) <= kThetaTolerance_rad) {
      if (!(reach_m > 0.0)) return std::nullopt;
      return SightAngle{theta, reach_m};
    }
  }
  return std::nullopt;
}

}  // namespace rockyard::vision
