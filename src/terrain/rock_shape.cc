#include "terrain/rock_shape.h"

#include <algorithm>

namespace rockyard::terrain {

using math::Vector3;

// With s = 1 - q.z for the point q + t e the surface is F(t) = 0 of
//   F = q.x^2 + q.y^2 - (A + B s) s = F0 + 2 k t + w t^2,
// and the ray enters where F falls through zero: t = (-k - sqrt(k^2 - w F0)) / w, whatever the sign
// of w. A hyperboloid has a second sheet, above its top, which is thrown away: there the slope
// A/2 + B s, half of dF/dq.z, is negative.
double RockShape::DistanceToCap(const Vector3& origin_W, const Vector3& direction_W) const {
  const Vector3 q = Map(origin_W - center_W_);
  const Vector3 e = Map(direction_W);
  const double s = 1.0 - q.z();
  const auto slope = [this](double at_s) { return 0.5 * growth_ + bend_ * at_s; };
  const auto on_cap = [&slope](double at_s) { return slope(at_s) > 0.0 && at_s <= 1.0; };
  const double outside = q.x() * q.x() + q.y() * q.y() - (growth_ + bend_ * s) * s;
  if (outside <= 0.0 && on_cap(s)) return 0.0;
  // ds/dt = -e.z.
  const double k = q.x() * e.x() + q.y() * e.y() + slope(s) * e.z();
  const double w = e.x() * e.x() + e.y() * e.y() - bend_ * e.z() * e.z();
  const double discriminant = k * k - w * outside;
  // The ray's line crosses the plane of the base, q.z = 0, at t = -q.z / e.z, where F is `at_base`
  // over e.z^2. Where that is above zero, a ray from above meets the cap only if F was lower in
  // between: most rays meet the surface below the base. What can be known without a root makes one
  // condition, which nearly always holds.
  const double slope_at_base = w * q.z() - k * e.z();
  const double at_base = outside * e.z() * e.z() + (slope_at_base - k * e.z()) * q.z();
  const bool rises = std::min(k, w) >= 0.0;
  const bool passes = at_base > 0.0 && std::min(w, slope_at_base) <= 0.0;
  if (rises || passes || discriminant < 0.0) return kNoHit;
  const double root = std::sqrt(discriminant);
  // The same root in the form in which nothing cancels.
  const double t = k <= 0.0 ? outside / (root - k) : -(k + root) / w;
  // Written so that a t that is not a number misses.
  return t > 0.0 && on_cap(s - t * e.z()) ? t : kNoHit;
}

// The gradient of F / 2.
Vector3 RockShape::CapNormal(const Vector3& p_W) const {
  const Vector3 q = Map(p_W - center_W_);
  const double slope = 0.5 * growth_ + bend_ * (1.0 - q.z());
  return Vector3(xx_ * q.x() + yx_ * q.y(), xy_ * q.x() + yy_ * q.y(), zz_ * slope).normalized();
}

double RockShape::CapTop(double rho2) const {
  if (rho2 > 1.0) return -kNoHit;
  // The smaller root of A s + B s^2 = rho^2.
  const double root = std::sqrt(std::max(0.0, growth_ * growth_ + 4.0 * bend_ * rho2));
  const double s = 2.0 * rho2 / (growth_ + root);
  return center_W_.z() + (1.0 - s) / zz_;
}

}  // namespace rockyard::terrain
