#include "vision/cameras/lens_camera.h"

#include <cmath>
#include <numbers>

#include "vision/lens.h"

namespace rockyard::vision {
namespace {

using math::Vector3;
using messages::Lens;

// The derivative of the lens's angles a (to the right) and b (downwards) by the point; the
// equations of a and b stand in vision/lens.h.
PixelJacobian AnglesByPoint(Lens lens, const Vector3& p) {
  PixelJacobian by_point;
  switch (lens) {
    case Lens::kEquidistantRows: {
      const double in_row = std::hypot(p.x(), p.z());
      const double squared = p.squaredNorm();
      by_point << p.y() * p.x() / (in_row * squared), -in_row / squared,
          p.y() * p.z() / (in_row * squared), p.z() / (in_row * in_row), 0.0,
          -p.x() / (in_row * in_row);
      return by_point;
    }
    case Lens::kEquidistant: {
      const Eigen::Vector2d across(p.y(), p.z());
      const double aside = across.norm();
      if (aside == 0.0) {
        by_point << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0;
        return by_point / p.x();
      }
      // (a, b) = -theta u, u = (y, z) / aside; dtheta = (x daside - aside dx) / |p|^2.
      const Eigen::Vector2d u = across / aside;
      const double theta_rad = std::atan2(aside, p.x());
      const double by_aside = p.x() / p.squaredNorm();
      by_point.col(0) = aside / p.squaredNorm() * u;
      by_point.rightCols<2>() =
          -by_aside * u * u.transpose() -
          theta_rad / aside * (Eigen::Matrix2d::Identity() - u * u.transpose());
      return by_point;
    }
    case Lens::kPinhole:
      break;
  }
  by_point << p.y() / p.x(), -1.0, 0.0, p.z() / p.x(), 0.0, -1.0;
  return by_point / p.x();
}

Pixel Pitches(const LensCamera& camera) {
  return {camera.lens.column_pitch_rad, camera.lens.row_pitch_rad};
}

// Whether the position, as angles from the axis, is one that Project can give.
bool IsDirection(Lens lens, const Pixel& angles_rad) {
  if (!angles_rad.allFinite()) return false;
  const double a = std::fabs(angles_rad.x());
  const double b = std::fabs(angles_rad.y());
  if (lens == Lens::kEquidistantRows) return HasDirections(lens, a, 0.0) && b < std::numbers::pi;
  return HasDirections(lens, a, b);
}

}  // namespace

LensCamera LensCameraOf(const messages::Camera& camera) {
  return {camera, Pixel(-camera.image_columns().first, -camera.first_row())};
}

std::optional<Pixel> Project(const LensCamera& camera, const Vector3& p_A,
                             PixelJacobian* jacobian) {
  const math::Transform& X_AC = camera.lens.X_RC;
  const Vector3 p_C = X_AC.linear().transpose() * (p_A - X_AC.translation());
  if (!(p_C.squaredNorm() > 0.0)) return std::nullopt;
  const std::optional<PixelPosition> position = Project(camera.lens, p_C);
  if (!position) return std::nullopt;
  const Pixel pixel = camera.axis_px + Pixel(position->column_px, position->row_px);
  if (!pixel.allFinite()) return std::nullopt;
  if (jacobian != nullptr) {
    *jacobian = Pitches(camera).cwiseInverse().asDiagonal() * AnglesByPoint(camera.lens.lens, p_C) *
                X_AC.linear().transpose();
  }
  return pixel;
}

std::optional<Ray> BackProject(const LensCamera& camera, const Pixel& pixel,
                               RayJacobian* jacobian) {
  const Pixel from_axis = pixel - camera.axis_px;
  if (!IsDirection(camera.lens.lens, from_axis.cwiseProduct(Pitches(camera)))) return std::nullopt;
  const math::Transform& X_AC = camera.lens.X_RC;
  const Vector3 direction_C = PixelRay(camera.lens, {from_axis.x(), from_axis.y()});
  const std::optional<Ray> ray = Finite({X_AC.translation(), X_AC.linear() * direction_C});
  if (ray && jacobian != nullptr) {
    PixelJacobian by_point;
    if (!Project(camera, ray->origin + ray->direction, &by_point)) return std::nullopt;
    jacobian->origin.setZero();
    jacobian->direction = DirectionByPixel(by_point);
  }
  return ray;
}

LensCamera Moved(const math::Transform& X_BA, const LensCamera& camera) {
  LensCamera moved = camera;
  moved.lens.X_RC = X_BA * camera.lens.X_RC;
  return moved;
}

LensCamera Mapped(const LensCamera& camera, const PixelMap& map) {
  LensCamera mapped = camera;
  mapped.lens.column_pitch_rad /= map.scale;
  mapped.lens.row_pitch_rad /= map.scale;
  mapped.axis_px = map(camera.axis_px);
  return mapped;
}

}  // namespace rockyard::vision
