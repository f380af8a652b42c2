#include "sensing/stereo_rig.h"

#include <cmath>
#include <cstdint>

#include "rendering/picture/pixel_rays.h"
#include "rendering/rover_body.h"
#include "sensing/rover_parts.h"
#include "sensing/stereo_view.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;
using vision::Image;

// Returns the view of the images before they are reduced. Its field of view must be the same, so
// that the mean of 2^level x 2^level pixels lies around the ray of its range point.
StereoView FullView(StereoParams params, LookDirection direction) {
  params.columns = params.image_columns();
  params.rows = params.image_rows();
  return MakeStereoView(params, direction);
}

// Returns the linear camera at `eye` whose pixel (0, 0) looks along view.first: the inverse of the
// rays e(column, row) of StereoView.
vision::CameraModel CameraAt(const StereoView& view, const Vector3& eye) {
  const double middle_column = 0.5 * (view.columns - 1);
  const double middle_row = 0.5 * (view.rows - 1);
  const Vector3 A =
      (view.first + middle_column * view.along_row + middle_row * view.along_column).normalized();
  // along_row = h' / f_h, hence H = f_h h' + c_h A with f_h h' = along_row / |along_row|^2.
  const Vector3 H = view.along_row / view.along_row.squaredNorm() + middle_column * A;
  const Vector3 V = view.along_column / view.along_column.squaredNorm() + middle_row * A;
  return {vision::Cahv{eye, A, H, V}, {view.columns, view.rows}};
}

// Returns a mask: 1 where the ray of a pixel meets no part of the rover, else 0.
Image<std::uint8_t> FreePixels(const vision::CameraModel& camera,
                               const rendering::RoverBody& body) {
  const rendering::PixelRays rays(camera);
  Image<std::uint8_t> free(rays.columns(), rays.rows(), 1);
  for (int row = 0; row < free.height(); ++row) {
    for (int column = 0; column < free.width(); ++column) {
      const vision::Ray ray = rays.At(column, row);
      const bool blocked = std::isfinite(body.Distance(ray.origin, ray.direction));
      if (blocked) free.At(column, row) = 0;
    }
  }
  return free;
}

}  // namespace

std::pair<vision::CameraModel, vision::CameraModel> CalibratedCameras(const StereoParams& params,
                                                                      LookDirection direction) {
  const StereoView view = FullView(params, direction);
  return {CameraAt(view, view.eye), CameraAt(view, view.right_eye)};
}

vision::StereoRig CalibratedRig(const StereoParams& params, const rover::RoverGeometryParams& rover,
                                LookDirection direction) {
  // The rover knows where it shows in the images of the pair as it was calibrated.
  const rendering::RoverBody body = MakeRoverBody(rover);
  auto [left, right] = CalibratedCameras(params, direction);
  return {left, right, FreePixels(left, body), FreePixels(right, body)};
}

}  // namespace rockyard::sensing
