#include "perception/triangulation.h"

#include <cmath>

namespace rockyard::perception {

using math::Vector3;
using messages::kStripeRows;
using messages::kStripes;

Triangulator::Triangulator(const messages::StripeCalibration& calibration)
    : calibration_(calibration) {
  for (std::size_t camera = 0; camera < scanlines_.size(); ++camera) {
    const auto rotation = calibration_.cameras[camera].X_RC.linear();
    for (std::size_t row = 0; row < kStripeRows; ++row) {
      const double depression = calibration_.row_angle_rad[row];
      scanlines_[camera][row] = {
          rotation * Vector3(std::cos(depression), 0.0, -std::sin(depression)),
          rotation * Vector3::UnitY()};
    }
  }
}

messages::ElevationScan Triangulator::Elevations(const messages::StripeScan& scan) const {
  messages::ElevationScan elevations;
  elevations.number = scan.number;
  for (std::size_t row = 0; row < kStripeRows; ++row) {
    for (std::size_t stripe = 0; stripe < kStripes; ++stripe) {
      const messages::StripePixel& pixel = scan.pixels[row][stripe];
      if (!pixel.detected) continue;
      const messages::StripeLaser& laser = calibration_.lasers[stripe];
      const auto camera_index = static_cast<std::size_t>(laser.camera);
      const messages::StripeCamera& camera = calibration_.cameras[camera_index];
      const Scanline& scanline = scanlines_[camera_index][row];

      const double angle = pixel.column_px * camera.column_pitch_rad;
      const Vector3 ray_R =
          std::cos(angle) * scanline.forward_R - std::sin(angle) * scanline.left_R;
      const Vector3 p_RoC_R = camera.X_RC.translation();
      const double distance_m =
          laser.normal_R.dot(laser.p_RoE_R - p_RoC_R) / laser.normal_R.dot(ray_R);
      if (!(distance_m > 0.0) || !std::isfinite(distance_m)) continue;
      const double z_m = p_RoC_R.z() + distance_m * ray_R.z();
      elevations.points[row][stripe] = {.detected = true,
                                        .elevation_m = z_m - calibration_.datum_z_m};
    }
  }
  return elevations;
}

}  // namespace rockyard::perception
