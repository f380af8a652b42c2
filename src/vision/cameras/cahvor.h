// CAHVOR: CAHV with radial distortion about an optical axis of its own (Gennery 2001,
// "Least-squares camera calibration including lens distortion and automatic editing of calibration
// points").
//
//   zeta = (p - C) . O    lambda = (p - C) - zeta O    tau = |lambda|^2 / zeta^2
//   p' = zeta O + (1 + R0 + R1 tau + R2 tau^2) lambda
//   column = p' . H / p' . A        row = p' . V / p' . A
//
// O is used as a unit vector: flight calibrations print it with six digits, and its length is
// divided out here. A keeps its length, of which the ratios with H and V are made.
#pragma once

#include <optional>

#include "vision/cameras/cahv.h"
#include "vision/cameras/radial_polynomial.h"

namespace rockyard::vision {

struct Cahvor {
  Cahv linear;
  math::Vector3 O = math::Vector3::UnitZ();
  math::Vector3 R = math::Vector3::Zero();

  bool operator==(const Cahvor&) const = default;
};

// As for a Cahv. Nothing, too, for points not in front of the lens (zeta > 0) and for what lies
// beyond the part from the axis outwards where the distorted radius grows: p' would fold back.
std::optional<Pixel> Project(const Cahvor& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// As for a Cahv; nothing beyond the image of the growing part. Iterates as Undistort does.
std::optional<Ray> BackProject(const Cahvor& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

Cahvor Moved(const math::Transform& X_BA, const Cahvor& camera);

Cahvor Mapped(const Cahvor& camera, const PixelMap& map);

// (1 + R0) + R1 r^2 + R2 r^4.
inline RadialPolynomial DistortionOf(const math::Vector3& R) {
  return {{1.0 + R[0], R[1], R[2], 0.0}};
}

}  // namespace rockyard::vision
