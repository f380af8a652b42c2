#include "rendering/picture/picture.h"

#include <cmath>
#include <limits>
#include <optional>

#include "rendering/occlusion.h"

namespace rockyard::rendering {

using math::Vector3;

StereoTruth SeenFromOtherEye(const PictureScene& scene, const Picture& picture,
                             const PixelRays& rays, const math::Transform& X_WA,
                             const vision::CameraModel& other_camera) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  const int columns = picture.columns();
  const int rows = picture.rows();
  StereoTruth truth{vision::Image<OtherEye>(columns, rows, OtherEye::kNone),
                    vision::Image<double>(columns, rows, kNowhere),
                    vision::Image<double>(columns, rows, kNowhere)};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double range_m = picture.range_m.At(column, row);
      if (!std::isfinite(range_m)) continue;
      const vision::Ray ray = rays.At(column, row);
      const Vector3 p_A = ray.origin + range_m * ray.direction;
      const std::optional<vision::Pixel> position = Project(other_camera, p_A);
      OtherEye& other = truth.other.At(column, row);
      other = OtherEye::kOutside;
      if (!position) continue;
      truth.other_column.At(column, row) = position->x();
      truth.other_row.At(column, row) = position->y();
      const auto sight = BackProject(other_camera, *position);
      if (!sight || !IsInside(other_camera.size, *position)) continue;
      other =
          scene.Hides(X_WA * p_A, X_WA * sight->origin) ? OtherEye::kOccluded : OtherEye::kVisible;
    }
  }
  return truth;
}

}  // namespace rockyard::rendering
