#include "vision/cameras/image_plane.h"

#include <cmath>

namespace rockyard::vision {

using math::Vector3;

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
