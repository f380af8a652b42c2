#include "terrain/rock_holding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rockyard::terrain {
namespace {

// Extent of the outline across a horizontal direction, m. An ellipse's support along a unit vector
// at the angle t to its x axis is sqrt((a cos t)^2 + (b sin t)^2); across the push t turns by 90
// deg.
double WidthAcross(const Rock& rock, const math::Vector3& push_W) {
  const double along =
      push_W.norm() > 0.0 ? std::atan2(push_W.y(), push_W.x()) - rock.yaw_rad : 0.0;
  return 2.0 *
         std::hypot(rock.semi_axes_m.x() * std::sin(along), rock.semi_axes_m.y() * std::cos(along));
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
  const double root = std::tan(0.25 * std::numbers::pi + 0.5 * params.soil_friction_angle_rad);
  const double pressure_N_m3 = root * root * params.soil_density_kg_m3 * gravity_m_s2;
  return friction_N + 0.5 * pressure_N_m3 * depth_m * depth_m * WidthAcross(rock, push_W);
}

}  // namespace rockyard::terrain
