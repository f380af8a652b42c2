// Light stripe triangulation: image columns to elevations.
#pragma once

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/estimates.h"

namespace rockyard::perception {

// Meets each found pixel's viewing ray with its laser's light plane, with the geometry that the
// rover believes. The ray of column c in the scanline at depression d below the optical axis is
// (cos c cos d, -sin c, -cos c sin d) in the camera frame. A ray that meets the light plane behind
// the camera, or not at all, is no detection.
class Triangulator {
 public:
  explicit Triangulator(const messages::StripeCalibration& calibration);

  // Elevations above the datum plane of the calibration, in R.
  messages::ElevationScan Elevations(const messages::StripeScan& scan) const;

 private:
  // A scanline of one camera: ray(c) = cos(c) forward - sin(c) left.
  struct Scanline {
    math::Vector3 forward_R;
    math::Vector3 left_R;
  };

  messages::StripeCalibration calibration_;
  std::array<std::array<Scanline, messages::kStripeRows>, 2> scanlines_;  // [camera][row]
};

}  // namespace rockyard::perception
