#include "rendering/surface_point.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rendering {

using math::Vector3;

bool IsOneSurface(const SurfacePoint& a, const SurfacePoint& b) {
  constexpr double kFlat = 0.3;  // sine of the angle between chord and tangent plane
  if (a.surface != b.surface) return false;
  if (a.surface == SurfacePoint::kSky) return true;
  const Vector3 chord = b.p_W - a.p_W;
  const double out = std::max(std::abs(a.normal_W.dot(chord)), std::abs(b.normal_W.dot(chord)));
  return out * out <= kFlat * kFlat * chord.squaredNorm();
}

}  // namespace rockyard::rendering
