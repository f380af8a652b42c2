#include "vision/cylinder/sight_lines.h"

#include <cmath>
#include <variant>

#include "vision/cameras/rectification.h"

namespace rockyard::vision {
namespace {

// sin^2 of the angle between two lines of sight below which they are parallel.
constexpr double kParallel = 1e-12;

// The middle of the shortest line between two lines of sight, p_i = o_i + s_i d_i.
std::optional<math::Vector3> NearestPoint(const Ray& a, const Ray& b) {
  const math::Vector3 between = b.origin - a.origin;
  const double cosine = a.direction.dot(b.direction);
  const double sine2 = 1.0 - cosine * cosine;
  if (sine2 < kParallel) return std::nullopt;
  const double along_a = between.dot(a.direction - cosine * b.direction) / sine2;
  const double along_b = between.dot(cosine * a.direction - b.direction) / sine2;
  if (along_a <= 0.0 || along_b <= 0.0) return std::nullopt;
  return 0.5 * (a.origin + along_a * a.direction + b.origin + along_b * b.direction);
}

std::optional<math::Vector3> AnyPointSeenAt(const ColourPair& pair, const Pixel& left_px,
                                            const Pixel& right_px) {
  const auto left = BackProject(pair.left_camera, left_px);
  const auto right = BackProject(pair.right_camera, right_px);
  if (!left || !right) return std::nullopt;
  return NearestPoint(*left, *right);
}

std::optional<math::Vector3> AlignedPointSeenAt(const RectifiedPair& aligned, const Pixel& left_px,
                                                const Pixel& right_px) {
  const auto point = Triangulate(aligned.left, aligned.right, left_px, left_px.x() - right_px.x());
  if (!point) return std::nullopt;
  return point->p_A;
}

}  // namespace

std::optional<EyeGeometry> GeometryOf(const ColourPair& pair) {
  const auto middle = BackProject(pair.left_camera, MiddleOf(pair.left_camera.size));
  if (!middle) return std::nullopt;
  EyeGeometry eyes;
  eyes.centre_L = CentreOf(pair.left_camera);
  const math::Vector3 right_centre_L = CentreOf(pair.right_camera);
  eyes.baseline_m = (right_centre_L - eyes.centre_L).norm();
  eyes.middle_L = 0.5 * (eyes.centre_L + right_centre_L);
  eyes.forward_L = middle->direction;
  if (const auto* linear = std::get_if<Cahv>(&pair.left_camera.lens)) {
    eyes.forward_L = linear->A.normalized();
  }
  PixelJacobian by_point;
  const auto again = Project(pair.left_camera, middle->origin + middle->direction, &by_point);
  if (!again) return std::nullopt;
  // At a depth of one metre along the axis.
  eyes.focal_px = by_point.row(0).norm() * middle->direction.dot(eyes.forward_L);
  const Eigen::Matrix<double, 3, 2> by_pixel = DirectionByPixel(by_point);
  eyes.right_L = by_pixel.col(0).normalized();
  eyes.up_L = -by_pixel.col(1).normalized();
  eyes.aligned = AlignedPair(pair.left_camera, pair.right_camera);
  if (eyes.aligned) eyes.focal_px = eyes.aligned->focal_px;
  return eyes;
}

std::optional<SeenPoint> PointSeenAt(const ColourPair& pair, const EyeGeometry& eyes,
                                     const Pixel& left_px, const Pixel& right_px) {
  const auto p_L = eyes.aligned ? AlignedPointSeenAt(*eyes.aligned, left_px, right_px)
                                : AnyPointSeenAt(pair, left_px, right_px);
  if (!p_L) return std::nullopt;
  const double depth_m = (*p_L - eyes.centre_L).dot(eyes.forward_L);
  if (!(depth_m > 0.0)) return std::nullopt;
  return SeenPoint{*p_L, depth_m};
}

}  // namespace rockyard::vision
