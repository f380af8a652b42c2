// Light stripe images made by hand.
#pragma once

#include <algorithm>
#include <cstdint>

#include "messages/calibration.h"
#include "messages/stripe_images.h"

namespace rockyard::perception {

// Two cameras 0.25 m above the datum plane that look along x; one scanline 200 rows below the axis,
// at a depression of 0.5 rad; one laser, whose light plane is parallel to the axes, 0.1 m to the
// left. Flat ground appears at 0.25 / sin 0.5 = 0.521 m, column -1000 atan(0.1 / 0.521) = -190.
inline messages::StripeCalibration OneLaser() {
  messages::StripeCalibration calibration;
  for (messages::Camera& camera : calibration.cameras) {
    camera.X_RC.translation() = math::Vector3(0.0, 0.0, 0.25);
    camera.column_pitch_rad = 0.001;
    camera.row_pitch_rad = 0.0025;
    camera.columns = 768;
    camera.rows = 484;
  }
  const messages::StripeLaser laser{.p_RoE_R = math::Vector3(0.0, 0.1, 0.25)};
  calibration.lasers = {laser};
  calibration.scanline_px = {200};
  return calibration;
}

// A second laser in the same image, 0.1 m farther to the left: flat ground at column -367.
inline messages::StripeCalibration TwoLasers() {
  messages::StripeCalibration calibration = OneLaser();
  messages::StripeLaser outer = calibration.lasers[0];
  outer.p_RoE_R.y() = 0.2;
  calibration.lasers.insert(calibration.lasers.begin(), outer);
  return calibration;
}

inline messages::ImageBand EvenBand(std::uint16_t counts, int rows = 5, int columns = 768) {
  const auto pixels = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  return {200 - rows / 2, -columns / 2, rows, columns, std::vector(pixels, counts)};
}

// The left camera with all lasers of group 0 on; nothing to see.
inline messages::StripeExposure DarkExposure() { return {0, 0, {EvenBand(20)}, {EvenBand(20)}}; }

// Adds a stripe `width` columns wide around `column`, no higher than the converter's full scale.
inline void AddStripe(messages::StripeExposure& exposure, int column, int counts, int width = 1,
                      int full_scale = 65535) {
  messages::ImageBand& band = exposure.lit[0];
  for (int row = 0; row < band.rows; ++row) {
    for (int i = 0; i < width; ++i) {
      const int at = row * band.columns + column - width / 2 + i - band.first_column;
      std::uint16_t& pixel = band.counts.at(static_cast<std::size_t>(at));
      pixel = static_cast<std::uint16_t>(std::min(pixel + counts, full_scale));
    }
  }
}

// Such a stripe before darkness.
inline messages::StripeExposure WithStripe(int column, int counts, int width = 1,
                                           int full_scale = 65535) {
  messages::StripeExposure exposure = DarkExposure();
  AddStripe(exposure, column, counts, width, full_scale);
  return exposure;
}

}  // namespace rockyard::perception
