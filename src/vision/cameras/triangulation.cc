#include "vision/cameras/triangulation.h"

#include "vision/cameras/image_plane.h"

namespace rockyard::vision {

std::optional<TriangulatedPoint> Triangulate(const Cahv& left, const Cahv& right,
                                             const Pixel& left_pixel, double disparity_px) {
  if (!(disparity_px > 0.0)) return std::nullopt;
  Eigen::Matrix<double, 3, 2> n_by_pixel;
  const std::optional<math::Vector3> n = LeavePlane(left, left_pixel, &n_by_pixel);
  if (!n) return std::nullopt;
  const double depth = left.H.dot(right.C - left.C) / disparity_px;
  TriangulatedPoint point;
  point.p_A = left.C + depth * *n;
  point.by_measurement.leftCols<2>() = depth * n_by_pixel;
  point.by_measurement.col(2) = -depth / disparity_px * *n;
  if (!point.p_A.allFinite() || !point.by_measurement.allFinite()) return std::nullopt;
  return point;
}

}  // namespace rockyard::vision
