#include "vision/cameras/cahv.h"

#include "vision/cameras/image_plane.h"

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
  const std::optional<Ray> ray = Finite({camera.C, direction});
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

}  // namespace rockyard::vision
