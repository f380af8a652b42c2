// Light stripe triangulation: image columns to elevations.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "vision/lens.h"

namespace rockyard::perception {

// Meets each found pixel's viewing ray (vision/lens.h) with its laser's light plane, with the
// geometry that the rover believes. A ray that meets the light plane behind the camera, or not at
// all, is no detection.
class Triangulator {
 public:
  explicit Triangulator(const messages::StripeCalibration& calibration);

  // Elevations above the datum plane of the calibration, in R.
  messages::ElevationScan Elevations(const messages::StripeScan& scan) const;

  // Elevation of one column of one point's scanline.
  messages::ElevationPoint Elevation(std::size_t row, std::size_t stripe, double column_px) const;

  // Where that column shows its stripe, p_RoP_R; none where Elevation is no detection.
  std::optional<math::Vector3> Point(std::size_t row, std::size_t stripe, double column_px) const;

 private:
  messages::StripeCalibration calibration_;
  std::array<std::vector<vision::ImageRow>, 2> scanlines_;  // [camera][row]
};

}  // namespace rockyard::perception
