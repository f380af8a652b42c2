#include "vision/cameras/cahv.h"

#include <cmath>

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
    // Of d / |d|: what is across the direction, over the length.
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

}  // namespace rockyard::vision
