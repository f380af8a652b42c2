// A pinhole with radial-tangential distortion (Brown 1966, "Decentering distortion of lenses";
// Conrady 1919), in the convention that OpenCV and the Middlebury calibrations use. For pairs of
// cameras from files (camera_file.h); no rover of rockyard's own has one, so that no record depends
// on it. The convention must stay, as people's files hold its numbers.
//
// Camera frame C: z along the optical axis, x along the rows to the right, y down the columns.
//
//   x = X / Z    y = Y / Z    r^2 = x^2 + y^2    g = 1 + k1 r^2 + k2 r^4 + k3 r^6
//   x' = x g + 2 p1 x y + p2 (r^2 + 2 x^2)
//   y' = y g + p1 (r^2 + 2 y^2) + 2 p2 x y
//   column = fx x' + cx        row = fy y' + cy
#pragma once

#include <optional>

#include "vision/cameras/camera_types.h"

namespace rockyard::vision {

struct BrownPinhole {
  math::Transform X_AC = math::Transform::Identity();
  double fx_px = 1.0;
  double fy_px = 1.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double k3 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;

  bool operator==(const BrownPinhole& other) const;
};

// Returns where p_A (m) is imaged, and its derivative by p_A. Returns nothing for points with
// Z <= 0; beyond the part from the axis outwards where r g grows; where the tangential terms fold
// the image (the determinant of d(x', y')/d(x, y) is not positive); and where the result is not
// finite.
std::optional<Pixel> Project(const BrownPinhole& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// Returns the ray of a pixel and its derivative by the pixel: the inverse of Project. Newton's
// method starts from the inverse of the radial part and takes at most 30 steps, to 1e-14. Returns
// nothing without convergence or where it ends outside of what Project images.
std::optional<Ray> BackProject(const BrownPinhole& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

BrownPinhole Moved(const math::Transform& X_BA, const BrownPinhole& camera);

BrownPinhole Mapped(const BrownPinhole& camera, const PixelMap& map);

}  // namespace rockyard::vision
