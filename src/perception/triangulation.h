// Light stripe triangulation: from image columns of points to elevations and places. Drives,
// studies of the sensor and replays turn scans into elevations here; stripe_finder.h works out by
// it where a stripe is looked for. Records depend on the bits of both forms: elevations are judged
// by Elevation, maps of stripes and pages take Point.
#pragma once

#include <optional>

#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/estimates.h"

namespace rockyard::perception {

// Meets the viewing ray (vision/lens.h) of each detected point with the light plane of its laser,
// by the geometry that the rover believes. Where the ray meets the plane behind the camera, or not
// at all, there is no detection.
class Triangulator {
 public:
  explicit Triangulator(const messages::StripeCalibration& calibration);

  // Returns the elevations above the datum plane of the calibration, along R's z, m.
  messages::ElevationScan Elevations(const messages::StripeScan& scan) const;

  // Returns the elevation at one column of one point's scanline: the height of Point above the
  // datum plane, by a closed form where the scanline is a plane, as searches ask for many columns.
  messages::ElevationPoint Elevation(std::size_t row, std::size_t stripe, double column_px) const;

  // Returns where the ray of that column meets the light plane, p_RoP_R; none where Elevation is no
  // detection.
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
