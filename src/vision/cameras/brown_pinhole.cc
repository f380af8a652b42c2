#include "vision/cameras/brown_pinhole.h"

#include <Eigen/LU>
#include <cmath>

#include "vision/cameras/radial_polynomial.h"

namespace rockyard::vision {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using math::Vector3;

constexpr int kMostBrownSteps = 30;
constexpr double kBrownTolerance = 1e-14;

RadialPolynomial RadialPart(const BrownPinhole& camera) {
  return {{1.0, camera.k1, camera.k2, camera.k3}};
}

struct DistortedSlope {
  Vector2d slope;
  Matrix2d by_slope;
};

DistortedSlope Distort(const BrownPinhole& camera, const Vector2d& slope) {
  const double x = slope.x();
  const double y = slope.y();
  const double t = slope.squaredNorm();
  const RadialPolynomial radial = RadialPart(camera);
  const double share = Share(radial, t);
  const double p1 = camera.p1;
  const double p2 = camera.p2;
  DistortedSlope distorted;
  distorted.slope = share * slope + Vector2d(2.0 * p1 * x * y + p2 * (t + 2.0 * x * x),
                                             p1 * (t + 2.0 * y * y) + 2.0 * p2 * x * y);
  distorted.by_slope =
      share * Matrix2d::Identity() + 2.0 * ShareSlope(radial, t) * slope * slope.transpose();
  Matrix2d tangential;
  tangential << p1 * y + 3.0 * p2 * x, p1 * x + p2 * y, p1 * x + p2 * y, 3.0 * p1 * y + p2 * x;
  distorted.by_slope += 2.0 * tangential;
  return distorted;
}

bool IsImaged(const BrownPinhole& camera, const Vector2d& slope, const DistortedSlope& distorted) {
  return GrowsUpTo(RadialPart(camera), slope.norm()) && distorted.by_slope.determinant() > 0.0;
}

// The slope whose distorted one is `wanted`.
std::optional<Vector2d> UndistortSlope(const BrownPinhole& camera, const Vector2d& wanted) {
  const double distorted_radius = wanted.norm();
  const std::optional<double> radius = Undistort(RadialPart(camera), distorted_radius);
  if (!radius) return std::nullopt;
  Vector2d slope = distorted_radius > 0.0 ? Vector2d(*radius / distorted_radius * wanted) : wanted;
  for (int step = 0; step < kMostBrownSteps; ++step) {
    const DistortedSlope distorted = Distort(camera, slope);
    const Vector2d change = distorted.by_slope.inverse() * (distorted.slope - wanted);
    slope -= change;
    if (change.norm() <= kBrownTolerance * (1.0 + slope.norm())) {
      if (!IsImaged(camera, slope, Distort(camera, slope))) return std::nullopt;
      return slope;
    }
  }
  return std::nullopt;
}

}  // namespace

bool BrownPinhole::operator==(const BrownPinhole& other) const {
  return X_AC.matrix() == other.X_AC.matrix() && fx_px == other.fx_px && fy_px == other.fy_px &&
         cx_px == other.cx_px && cy_px == other.cy_px && k1 == other.k1 && k2 == other.k2 &&
         k3 == other.k3 && p1 == other.p1 && p2 == other.p2;
}

std::optional<Pixel> Project(const BrownPinhole& camera, const Vector3& p_A,
                             PixelJacobian* jacobian) {
  const Vector3 p_C = camera.X_AC.linear().transpose() * (p_A - camera.X_AC.translation());
  if (!(p_C.z() > 0.0)) return std::nullopt;
  const Vector2d slope = p_C.head<2>() / p_C.z();
  const DistortedSlope distorted = Distort(camera, slope);
  if (!IsImaged(camera, slope, distorted)) return std::nullopt;
  const Vector2d focal(camera.fx_px, camera.fy_px);
  const Pixel pixel = focal.cwiseProduct(distorted.slope) + Vector2d(camera.cx_px, camera.cy_px);
  if (!pixel.allFinite()) return std::nullopt;
  if (jacobian != nullptr) {
    PixelJacobian slope_by_point;
    slope_by_point << Matrix2d::Identity(), -slope;
    slope_by_point /= p_C.z();
    *jacobian =
        focal.asDiagonal() * distorted.by_slope * slope_by_point * camera.X_AC.linear().transpose();
  }
  return pixel;
}

std::optional<Ray> BackProject(const BrownPinhole& camera, const Pixel& pixel,
                               RayJacobian* jacobian) {
  const Vector2d focal(camera.fx_px, camera.fy_px);
  const Vector2d wanted = (pixel - Vector2d(camera.cx_px, camera.cy_px)).cwiseQuotient(focal);
  const std::optional<Vector2d> slope = UndistortSlope(camera, wanted);
  if (!slope) return std::nullopt;
  const Vector3 d_C(slope->x(), slope->y(), 1.0);
  const Vector3 direction_C = d_C.normalized();
  const std::optional<Ray> ray =
      Finite({camera.X_AC.translation(), camera.X_AC.linear() * direction_C});
  if (ray && jacobian != nullptr) {
    PixelJacobian by_point;
    if (!Project(camera, ray->origin + ray->direction, &by_point)) return std::nullopt;
    jacobian->origin.setZero();
    jacobian->direction = DirectionByPixel(by_point);
  }
  return ray;
}

BrownPinhole Moved(const math::Transform& X_BA, const BrownPinhole& camera) {
  BrownPinhole moved = camera;
  moved.X_AC = X_BA * camera.X_AC;
  return moved;
}

BrownPinhole Mapped(const BrownPinhole& camera, const PixelMap& map) {
  BrownPinhole mapped = camera;
  mapped.fx_px *= map.scale;
  mapped.fy_px *= map.scale;
  mapped.cx_px = map.scale * camera.cx_px + map.shift.x();
  mapped.cy_px = map.scale * camera.cy_px + map.shift.y();
  return mapped;
}

}  // namespace rockyard::vision
