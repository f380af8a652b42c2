// The rigid motion between two sets of points, in closed form.
#pragma once

#include <optional>
#include <span>

#include "math/pose.h"

namespace rockyard::vision {

// X_FS with the least sum of |p_F - X_FS p_S|^2 (Horn 1987; by singular values: Arun, Huang and
// Blostein 1987, with Umeyama's 1991 sign, so that it is never a reflection). Both have the same
// number of points. Nothing for fewer than three points, for points on one line or in one place
// (less than 1e-6 of the spread across the longest direction), and where a number is not finite.
std::optional<math::Transform> RigidMotion(std::span<const math::Vector3> points_F,
                                           std::span<const math::Vector3> points_S);

}  // namespace rockyard::vision
