#include "terrain/rock.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/check.h"

namespace rockyard::terrain {
namespace {

constexpr int kPlanCorners = 8;
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
  // What has no height has no profile.
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
  // The top stands at h, an ellipsoid's centre c below it; that of a cap is its height below.
  rock.center_W.z() = h_m - rock.semi_axes_m.z();
  return rock;
}

math::Vector3 OnRock(const Rock& rock, const math::Vector3& unit) {
  // p_W = centre + Rz(yaw) diag(a, b, c) u.
  const math::Vector3 p = unit.cwiseProduct(rock.semi_axes_m);
  const double c = std::cos(rock.yaw_rad);
  const double s = std::sin(rock.yaw_rad);
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
    corners.push_back(OnRock(rock, {std::cos(angle), std::sin(angle), 0.0}));
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
      points.push_back(OnRock(rock, {radius * std::cos(angle), radius * std::sin(angle), height}));
    }
  }
  points.push_back(OnRock(rock, math::Vector3::UnitZ()));
  return points;
}

}  // namespace rockyard::terrain
