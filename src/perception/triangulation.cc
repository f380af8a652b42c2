#include "perception/triangulation.h"

#include <cmath>

namespace rockyard::perception {

using math::Vector3;

Triangulator::Triangulator(const messages::StripeCalibration& calibration)
    : calibration_(calibration) {
  for (std::size_t camera = 0; camera < scanlines_.size(); ++camera) {
    for (const int row_px : calibration_.scanline_px) {
      scanlines_[camera].emplace_back(calibration_.cameras[camera], row_px);
    }
  }
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
  const std::optional<Vector3> p_RoP_R = Point(row, stripe, column_px);
  if (!p_RoP_R) return {};
  return {.detected = true, .elevation_m = p_RoP_R->z() - calibration_.datum_z_m};
}

std::optional<Vector3> Triangulator::Point(std::size_t row, std::size_t stripe,
                                           double column_px) const {
  const messages::StripeLaser& laser = calibration_.lasers[stripe];
  const auto camera_index = static_cast<std::size_t>(laser.camera);
  const messages::StripeCamera& camera = calibration_.cameras[camera_index];
  const Vector3 ray_R = camera.X_RC.linear() * scanlines_[camera_index][row].Ray(column_px);
  const Vector3 p_RoC_R = camera.X_RC.translation();
  const double distance_m = laser.normal_R.dot(laser.p_RoE_R - p_RoC_R) / laser.normal_R.dot(ray_R);
  if (!(distance_m > 0.0) || !std::isfinite(distance_m)) return std::nullopt;
  return p_RoC_R + distance_m * ray_R;
}

}  // namespace rockyard::perception
