#include "terrain/rock.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::terrain {

namespace {

// These numbers are for drawings alone.
constexpr int kPlanCorners = 8;
// Rings of so many points leave 1 - cos(pi / 16) = 2 % of a rock's width outside of their hull
// (PointsAbove).
constexpr int kRingPoints = 16;
constexpr int kRings = 6;

}  // namespace

Rock ShapeRock(const RockOutline& outline, double pointedness) {
  EXPECT(pointedness >= 0.0 && pointedness < 1.0);
  const double h_m = outline.height_m;
  Rock rock;
  rock.diameter_m = outline.diameter_m;
  rock.height_m = h_m;
  const double a_m = 0.5 * outline.diameter_m;
  rock.semi_axes_m = {a_m, a_m * outline.width_ratio, outline.half_height_m};
  // A rock without height has no profile.
  if (pointedness > 0.0 && h_m > 0.0) {
    const double growth = (1.0 - pointedness) * 2.0 * h_m / outline.half_height_m;
    if (growth < 2.0) {
      rock.semi_axes_m.z() = h_m;
      rock.cap_growth = growth;
    } else {
      // A = 2 h / c solved for c.
      rock.semi_axes_m.z() = 2.0 * h_m / growth;
    }
  }
  // The top stands at h. The centre lies c below it; for a cap that is its height.
  rock.center_W.z() = h_m - rock.semi_axes_m.z();
  return rock;
}

math::Vector3 OnRock(const Rock& rock, const math::Vector3& unit) {
  // p_W = centre + Rz(yaw) diag(a, b, c) u.
  const math::Vector3 p = unit.cwiseProduct(rock.semi_axes_m);
  const auto [s, c] = math::SinCos(rock.yaw_rad);
  return rock.center_W + math::Vector3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
}

double ParallelRadius(const Rock& rock, double unit_height) {
  if (rock.cap_growth == 0.0) return std::sqrt(std::max(0.0, 1.0 - unit_height * unit_height));
  // rho^2 = A s + (1 - A) s^2 at the share s of the height below the top.
  const double s = 1.0 - unit_height;
  return std::sqrt(std::max(0.0, (rock.cap_growth + (1.0 - rock.cap_growth) * s) * s));
}

std::vector<math::Vector3> PlanOutline(const Rock& rock) {
  std::vector<math::Vector3> corners;
  corners.reserve(kPlanCorners);
  for (int i = 0; i < kPlanCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kPlanCorners;
    corners.push_back(OnRock(rock, {math::Cos(angle), math::Sin(angle), 0.0}));
  }
  return corners;
}

std::vector<math::Vector3> PointsAbove(const Rock& rock, double ground_m) {
  const double lowest = rock.cap_growth > 0.0 ? 0.0 : -1.0;
  const double ground = (ground_m - rock.center_W.z()) / rock.semi_axes_m.z();
  const double from = std::max(lowest, ground);
  if (from >= 1.0) return {};
  std::vector<math::Vector3> points;
  points.reserve(kRings * kRingPoints + 1);
  for (int ring = 0; ring < kRings; ++ring) {
    // Denser towards the top, where the surface bends.
    const double below_top = 1.0 - static_cast<double>(ring) / kRings;
    const double height = 1.0 - (1.0 - from) * below_top * below_top;
    const double radius = ParallelRadius(rock, height);
    for (int i = 0; i < kRingPoints; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kRingPoints;
      points.push_back(
          OnRock(rock, {radius * math::Cos(angle), radius * math::Sin(angle), height}));
    }
  }
  points.push_back(OnRock(rock, math::Vector3::UnitZ()));
  return points;
}

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
  // The smaller root is written in the form in which nothing cancels.
  const double t = k <= 0.0 ? outside / (root - k) : -(k + root) / w;
  // Written so that a t that is not a number misses.
  return t > 0.0 && on_cap(s - t * e.z()) ? t : kNoHit;
}

// The normal is along the gradient of F / 2.
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

namespace {

// Returns the extent of the outline across a horizontal direction, m. An ellipse's support along a
// unit vector at the angle t to its x axis is sqrt((a cos t)^2 + (b sin t)^2); across the push t
// turns by 90 deg.
double WidthAcross(const Rock& rock, const math::Vector3& push_W) {
  const double along =
      push_W.norm() > 0.0 ? math::Atan2(push_W.y(), push_W.x()) - rock.yaw_rad : 0.0;
  return 2.0 * math::Hypot(rock.semi_axes_m.x() * math::Sin(along),
                           rock.semi_axes_m.y() * math::Cos(along));
}

}  // namespace

double RockMass(const Rock& rock, double density_kg_m3) {
  // m = rho 4/3 pi a b c.
  return density_kg_m3 * 4.0 / 3.0 * std::numbers::pi * rock.semi_axes_m.prod();
}

double HoldingForce(const Rock& rock, const RockHoldingParams& params, double gravity_m_s2,
                    double load_N, const math::Vector3& push_W) {
  const double weight_N = RockMass(rock, params.rock_density_kg_m3) * gravity_m_s2;
  // Coulomb: mu N under weight and load; a rover that lifts the rock lightens it down to nothing.
  const double friction_N = params.rock_soil_friction * std::max(0.0, weight_N + load_N);
  // Buried part of the full height 2 c.
  const double depth_m = std::max(0.0, 2.0 * rock.semi_axes_m.z() - rock.height_m);
  // Rankine 1857: K_p = tan^2(45 deg + phi/2); the pressure K_p gamma z grows with depth, so its
  // sum over a wall of depth d and width w is K_p gamma d^2 w / 2.
  const double root = math::Tan(0.25 * std::numbers::pi + 0.5 * params.soil_friction_angle_rad);
  const double pressure_N_m3 = root * root * params.soil_density_kg_m3 * gravity_m_s2;
  return friction_N + 0.5 * pressure_N_m3 * depth_m * depth_m * WidthAcross(rock, push_W);
}

}  // namespace rockyard::terrain
