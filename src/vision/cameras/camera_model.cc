#include "vision/cameras/camera_model.h"

#include "core/check.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

const Vector3& CentreOfLens(const Cahv& lens) { return lens.C; }
const Vector3& CentreOfLens(const Cahvor& lens) { return lens.linear.C; }
const Vector3& CentreOfLens(const Cahvore& lens) { return lens.linear.C; }
Vector3 CentreOfLens(const BrownPinhole& lens) { return lens.X_AC.translation(); }

}  // namespace

std::optional<Pixel> Project(const CameraModel& camera, const Vector3& p_A,
                             PixelJacobian* jacobian) {
  return std::visit([&](const auto& lens) { return Project(lens, p_A, jacobian); }, camera.lens);
}

std::optional<Ray> BackProject(const CameraModel& camera, const Pixel& pixel,
                               RayJacobian* jacobian) {
  return std::visit([&](const auto& lens) { return BackProject(lens, pixel, jacobian); },
                    camera.lens);
}

std::optional<Pixel> ProjectDirection(const CameraModel& camera, const Vector3& direction_A) {
  // At this distance the centimetres by which a pupil moves are 1e-11 rad.
  constexpr double kFar_m = 1e9;
  return Project(camera, CentreOf(camera) + kFar_m * direction_A.normalized());
}

Vector3 CentreOf(const CameraModel& camera) {
  return std::visit([](const auto& lens) -> Vector3 { return CentreOfLens(lens); }, camera.lens);
}

bool IsInside(const ImageSize& size, const Pixel& pixel) {
  return pixel.x() >= -0.5 && pixel.x() < size.columns - 0.5 && pixel.y() >= -0.5 &&
         pixel.y() < size.rows - 0.5;
}

Pixel MiddleOf(const ImageSize& size) { return {0.5 * (size.columns - 1), 0.5 * (size.rows - 1)}; }

CameraModel Moved(const math::Transform& X_BA, const CameraModel& camera) {
  return {std::visit([&](const auto& lens) -> AnyLens { return Moved(X_BA, lens); }, camera.lens),
          camera.size};
}

CameraModel Reduced(const CameraModel& camera, int factor) {
  EXPECT(factor >= 1 && factor <= camera.size.columns && factor <= camera.size.rows);
  const double scale = 1.0 / factor;
  const PixelMap map{scale, Pixel::Constant(-0.5 * (factor - 1) * scale)};
  return {std::visit([&](const auto& lens) -> AnyLens { return Mapped(lens, map); }, camera.lens),
          {camera.size.columns / factor, camera.size.rows / factor}};
}

}  // namespace rockyard::vision
