/// @file
/// Angles in radians, for all modules; degrees appear only in JSON and in reports. core includes
/// this header, so that nothing here may include core. Must stay: degrees * pi / 180 in this order.
/// Parameters in degrees are read by it, so that the bits of records depend on it.
#pragma once

#include <cmath>
#include <numbers>

namespace rockyard::math {

/// Returns the angle in the other unit.
constexpr double DegToRad(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double RadToDeg(double radians) { return radians * 180.0 / std::numbers::pi; }

/// Returns the equivalent angle in [-pi, pi]. Angles in that range are the usual case and their own
/// remainder, which is exact: to skip the division changes no bit.
inline double WrapAngle(double radians) {
  if (std::abs(radians) <= std::numbers::pi) return radians;
  return std::remainder(radians, 2.0 * std::numbers::pi);
}

}  // namespace rockyard::math
