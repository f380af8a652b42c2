// What a viewing ray meets.
#pragma once

#include "math/pose.h"

namespace rockyard::rendering {

// The point that a viewing ray meets first.
struct SurfacePoint {
  // `surface` is the index of a rock, or one of these.
  static constexpr int kGround = -1;
  static constexpr int kWall = -2;
  static constexpr int kSky = -3;
  static constexpr int kRover = -4;

  math::Vector3 p_W = math::Vector3::Zero();
  math::Vector3 normal_W = math::Vector3::UnitZ();
  int surface = kSky;
  double albedo = 0.0;
  double radiance_w_m2_sr = 0.0;  // of sunlight within the passband

  // Lamps light the terrain; on the rover's own parts their light is left out.
  bool TakesLampLight() const { return surface >= kWall; }
};

// Returns whether a surface goes on from one point to the other: the same one, and the chord
// between them nearly in its tangent plane.
bool IsOneSurface(const SurfacePoint& a, const SurfacePoint& b);

}  // namespace rockyard::rendering
