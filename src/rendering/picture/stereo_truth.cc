#include "rendering/picture/stereo_truth.h"

#include <cmath>
#include <limits>

#include "rendering/occlusion.h"

namespace rockyard::rendering {

using math::Vector3;

StereoTruth SeenFromOtherEye(const PictureScene& scene, const Picture& picture,
                             const PixelRays& rays, const math::Transform& X_WA,
                             const Vector3& other_eye_A, const PixelOfPoint& other_image) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  const int columns = picture.columns();
  const int rows = picture.rows();
  StereoTruth truth{vision::Image<OtherEye>(columns, rows, OtherEye::kNone),
                    vision::Image<double>(columns, rows, kNowhere),
                    vision::Image<double>(columns, rows, kNowhere)};
  const Vector3 eye_W = X_WA * other_eye_A;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double range_m = picture.range_m.At(column, row);
      if (!std::isfinite(range_m)) continue;
      const ViewRay ray = rays.At(column, row);
      const Vector3 p_A = ray.origin_A + range_m * ray.direction_A;
      const auto position = other_image(p_A);
      OtherEye& other = truth.other.At(column, row);
      other = OtherEye::kOutside;
      if (!position) continue;
      truth.other_column.At(column, row) = position->column;
      truth.other_row.At(column, row) = position->row;
      if (position->column < -0.5 || position->column >= columns - 0.5 || position->row < -0.5 ||
          position->row >= rows - 0.5) {
        continue;
      }
      other = scene.Hides(X_WA * p_A, eye_W) ? OtherEye::kOccluded : OtherEye::kVisible;
    }
  }
  return truth;
}

}  // namespace rockyard::rendering
