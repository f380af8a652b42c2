#include "perception/triangulation.h"

#include <cmath>

#include "math/functions.h"
#include "vision/lens.h"

namespace rockyard::perception {

using math::Vector3;

namespace {

// Returns whether a ray meets the light plane before the camera. For a ray in the light plane the
// distance divides by zero and is not finite.
bool IsAhead(double distance_m) { return distance_m > 0.0 && std::isfinite(distance_m); }

}  // namespace

Triangulator::Triangulator(const messages::StripeCalibration& calibration)
    : calibration_(calibration) {
  geometry_ = messages::StripeArray<PointGeometry>(calibration_.size());
  for (std::size_t row = 0; row < geometry_.rows(); ++row) {
    for (std::size_t stripe = 0; stripe < geometry_.stripes(); ++stripe) {
      // Worked out once: it depends on the calibration alone.
      geometry_[row][stripe] = MakeGeometry(row, stripe);
    }
  }
}

Triangulator::PointGeometry Triangulator::MakeGeometry(std::size_t row, std::size_t stripe) const {
  const messages::StripeLaser& laser = calibration_.lasers[stripe];
  const messages::Camera& camera = calibration_.cameras[static_cast<std::size_t>(laser.camera)];
  const vision::PixelPosition middle{0.0, static_cast<double>(calibration_.scanline_px[row])};
  const Vector3 forward_R = camera.X_RC.linear() * vision::PixelRay(camera, middle);
  const Vector3 left_R = camera.X_RC.linear() * Vector3::UnitY();
  const Vector3 p_RoC_R = camera.X_RC.translation();
  // All that the elevation needs of light plane and scanline, in R and relative to the camera.
  return {.plane_offset_m = laser.normal_R.dot(laser.p_RoE_R - p_RoC_R),
          .forward_normal = laser.normal_R.dot(forward_R),
          .left_normal = laser.normal_R.dot(left_R),
          .forward_z = forward_R.z(),
          .left_z = left_R.z(),
          .camera_z_m = p_RoC_R.z() - calibration_.datum_z_m,
          .column_pitch_rad = camera.column_pitch_rad,
          .is_planar = camera.lens == messages::Lens::kEquidistantRows};
}

messages::ElevationScan Triangulator::Elevations(const messages::StripeScan& scan) const {
  messages::ElevationScan elevations{
      scan.number, messages::StripeArray<messages::ElevationPoint>(scan.pixels.size())};
  for (std::size_t row = 0; row < scan.pixels.rows(); ++row) {
    for (std::size_t stripe = 0; stripe < scan.pixels.stripes(); ++stripe) {
      const messages::StripePixel& pixel = scan.pixels[row][stripe];
      if (pixel.detected) elevations.points[row][stripe] = Elevation(row, stripe, pixel.column_px);
    }
  }
  return elevations;
}

messages::ElevationPoint Triangulator::Elevation(std::size_t row, std::size_t stripe,
                                                 double column_px) const {
  const PointGeometry& at = geometry_[row][stripe];
  // Rows that the lens bends have no such closed form.
  if (!at.is_planar) {
    const std::optional<Vector3> p_RoP_R = Point(row, stripe, column_px);
    if (!p_RoP_R) return {};
    return {.detected = true, .elevation_m = p_RoP_R->z() - calibration_.datum_z_m};
  }
  // Equidistant rows: column c looks along ray = cos(a) forward - sin(a) left, a = c pitch. It
  // meets the light plane n . (p - e) = 0 at s = n . (e - o) / n . ray, at the height o_z + s
  // ray_z.
  const auto [sine, cosine] = math::SinCos(column_px * at.column_pitch_rad);
  const double distance_m =
      at.plane_offset_m / (cosine * at.forward_normal - sine * at.left_normal);
  if (!IsAhead(distance_m)) return {};
  return {.detected = true,
          .elevation_m = at.camera_z_m + distance_m * (cosine * at.forward_z - sine * at.left_z)};
}

std::optional<Vector3> Triangulator::Point(std::size_t row, std::size_t stripe,
                                           double column_px) const {
  const messages::StripeLaser& laser = calibration_.lasers[stripe];
  const messages::Camera& camera = calibration_.cameras[static_cast<std::size_t>(laser.camera)];
  const Vector3 ray_R =
      camera.X_RC.linear() *
      vision::PixelRay(camera, {column_px, static_cast<double>(calibration_.scanline_px[row])});
  const Vector3 p_RoC_R = camera.X_RC.translation();
  // As in Elevation, s = n . (e - o) / n . ray, with the ray of any lens.
  const double distance_m = laser.normal_R.dot(laser.p_RoE_R - p_RoC_R) / laser.normal_R.dot(ray_R);
  if (!IsAhead(distance_m)) return std::nullopt;
  return p_RoC_R + distance_m * ray_R;
}

}  // namespace rockyard::perception
