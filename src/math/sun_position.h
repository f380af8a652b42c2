// Where the sun stands in the sky of Mars, by site, season and true solar time. The simulated sky,
// the rover's almanac and solar power must follow this one law: the rover errs about its sun sensor
// and its tilt, never about where the sun stands.
//
// With latitude phi, declination delta and hour angle H (0 at local noon, positive in the
// afternoon; spherical triangle of pole, zenith and sun):
//   sin(elevation) = sin(phi) sin(delta) + cos(phi) cos(delta) cos(H)
//   azimuth = atan2(-cos(delta) sin(H), sin(delta) cos(phi) - cos(delta) cos(H) sin(phi))
// from north over east. The declination follows from the areocentric longitude Ls of the sun,
// sin(delta) = sin(obliquity) sin(Ls), with an obliquity of 25.19 deg (Allison and McEwen 2000).
// Limits: true solar time runs evenly, at 24 hours a sol; within a sol the season stands still, and
// refraction (0.01 deg at most on Mars) is left out. Records of drives with aids that need the sun,
// or with solar power, depend on its bits.
#pragma once

#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "math/functions.h"
#include "math/pose.h"

namespace rockyard::math {

inline constexpr double kObliquityOfMars_rad = DegToRad(25.19);
inline constexpr double kSolOfMars_s = 88775.244;  // mean solar day (Allison and McEwen 2000)

// A direction in the sky.
struct SkyDirection {
  double azimuth_rad = 0.0;  // from north over east, in [-pi, pi]
  double elevation_rad = 0.0;
};

inline double SunDeclination(double areocentric_longitude_rad) {
  return Asin(Sin(kObliquityOfMars_rad) * Sin(areocentric_longitude_rad));
}

// Returns the direction to the sun. `solar_time_h`: true solar hours, 12 at noon, of any sol.
inline SkyDirection SunPosition(double latitude_rad, double declination_rad, double solar_time_h) {
  const double hour_angle_rad = (solar_time_h - 12.0) * std::numbers::pi / 12.0;
  const double sine = Sin(latitude_rad) * Sin(declination_rad) +
                      Cos(latitude_rad) * Cos(declination_rad) * Cos(hour_angle_rad);
  const double east = -Cos(declination_rad) * Sin(hour_angle_rad);
  const double north = Sin(declination_rad) * Cos(latitude_rad) -
                       Cos(declination_rad) * Cos(hour_angle_rad) * Sin(latitude_rad);
  return {Atan2(east, north), Asin(std::fmin(1.0, std::fmax(-1.0, sine)))};
}

// Returns the unit vector in W of a direction whose azimuth counts from north. North lies at
// `north_heading_rad` (from +x towards +y); east is clockwise from north, seen from above.
inline Vector3 ToUnitVector(const SkyDirection& direction, double north_heading_rad) {
  const double heading_rad = north_heading_rad - direction.azimuth_rad;
  const double level = Cos(direction.elevation_rad);
  return {level * Cos(heading_rad), level * Sin(heading_rad), Sin(direction.elevation_rad)};
}

}  // namespace rockyard::math
