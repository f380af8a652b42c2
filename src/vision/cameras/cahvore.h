// CAHVORE: CAHVOR for lenses up to fisheyes, whose entrance pupil moves along the axis (Gennery
// 2006, "Generalized camera calibration including fish-eye lenses").
//
//   zeta = (p - C) . O    lambda = (p - C) - zeta O
//   theta: zeta sin(theta) - |lambda| cos(theta) = (theta - sin(theta)) (E0 + E1 theta^2 + E2
//   theta^4) chi = sin(L theta) / L for L < 0, theta for L = 0, tan(L theta) / L for L > 0 p' = O +
//   chi (1 + R0 + R1 chi^2 + R2 chi^4) lambda / |lambda| column = p' . H / p' . A        row = p' .
//   V / p' . A
//
// The line of sight leaves the axis under theta at C + s O,
// s = (theta / sin(theta) - 1) (E0 + E1 theta^2 + E2 theta^4).
// The linearity L says which lens it is: 1 a perspective one, 0 a fisheye (r = f theta); in between
// 1/2 is stereographic and -1/2 equisolid. O is used as a unit vector, as in CAHVOR.
#pragma once

#include <optional>

#include "vision/cameras/cahvor.h"

namespace rockyard::vision {

// The types of the flight software, whose numbers are 1, 2 and 3.
enum class CahvoreType {
  kPerspective,  // L = 1
  kFisheye,      // L = 0
  kGeneral,      // L is a parameter
};

struct Cahvore {
  Cahv linear;
  math::Vector3 O = math::Vector3::UnitZ();
  math::Vector3 R = math::Vector3::Zero();
  math::Vector3 E = math::Vector3::Zero();  // m
  CahvoreType type = CahvoreType::kGeneral;
  double general_linearity = 1.0;  // of kGeneral, in [-1, 1]

  bool operator==(const Cahvore&) const = default;
};

double Linearity(const Cahvore& camera);

// The largest angle from the axis that a lens of this linearity can image at all, rad, not reached:
// pi / (2 |L|), and never more than pi.
double LargestAngle(double linearity);

// As for a Cahvor, with theta below LargestAngle. Newton's method from atan2(|lambda|, zeta), at
// most 30 steps, to 1e-14 rad; nothing where it does not get there, or where the point lies so near
// to a moving pupil that lines of sight cross before it.
std::optional<Pixel> Project(const Cahvore& camera, const math::Vector3& p_A,
                             PixelJacobian* jacobian = nullptr);

// As for a Cahvor; nothing beyond LargestAngle.
std::optional<Ray> BackProject(const Cahvore& camera, const Pixel& pixel,
                               RayJacobian* jacobian = nullptr);

Cahvore Moved(const math::Transform& X_BA, const Cahvore& camera);

Cahvore Mapped(const Cahvore& camera, const PixelMap& map);

}  // namespace rockyard::vision
