// Light stripe triangulation: image columns to elevations.
#pragma once

#include <optional>

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/estimates.h"

namespace rockyard::perception {

// Meets each found pixel's viewing ray (vision/lens.h) with its laser's light plane, with the
// geometry that the rover believes. A ray that meets the light plane behind the camera, or not at
// all, is no detection.
class Triangulator {
 public:
  explicit Triangulator(const messages::StripeCalibration& calibration);

  // Returns the elevations above the datum plane of the calibration, along R's z, m.
  messages::ElevationScan Elevations(const messages::StripeScan& scan) const;

  // Returns the elevation at one column of one point's scanline: the height of Point above the
  // datum plane, by a closed form where the scanline is a plane, as searches ask for many columns.
  messages::ElevationPoint Elevation(std::size_t row, std::size_t stripe, double column_px) const;

  // Returns where that column shows its stripe, p_RoP_R; none where Elevation is no detection.
  std::optional<math::Vector3> Point(std::size_t row, std::size_t stripe, double column_px) const;

 private:
  // The scanline and light plane of one point. Where the scanline is a plane, the ray of the angle
  // a is cos(a) forward - sin(a) left, and elevations need no more than its parts along the normal
  // of the light plane and along z.
  struct PointGeometry {
    double plane_offset_m = 0.0;  // light plane from the camera, along its normal
    double forward_normal = 0.0;
    double left_normal = 0.0;
    double forward_z = 0.0;
    double left_z = 0.0;
    double camera_z_m = 0.0;  // above the datum plane
    double column_pitch_rad = 0.0;
    bool is_planar = false;
  };

  PointGeometry MakeGeometry(std::size_t row, std::size_t stripe) const;

  messages::StripeCalibration calibration_;
  messages::StripeArray<PointGeometry> geometry_;
};

}  // namespace rockyard::perception
