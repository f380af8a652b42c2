// What holds a rock in the soil against a horizontal push.
#pragma once

#include "math/pose.h"
#include "terrain/rock.h"
#include "terrain/rock_params.h"

namespace rockyard::terrain {

// Returns the mass of the whole ellipsoid, kg.
double RockMass(const Rock& rock, double density_kg_m3);

// Returns the largest horizontal force, N, that the soil bears before a rock slides along push_W
// (horizontal; its length does not matter, zero stands for the rock's x axis):
//   mu max(0, m g + load) + 1/2 K gamma d^2 w,   K = tan^2(45 deg + phi / 2),   gamma = rho_soil g:
// Coulomb friction under the rock, load_N being the vertical force that the rover puts on it (down
// positive), and the passive pressure (Rankine 1857, no cohesion) on its front, a wall as deep as
// the rock is buried, d = 2 c - height_m, and as wide as the rock is across the push. The buried
// front of an ellipsoid is smaller than that wall, the wedge that it lifts is wider: neither is
// corrected. The ground is level, and nothing holds the rock from behind.
double HoldingForce(const Rock& rock, const RockHoldingParams& params, double gravity_m_s2,
                    double load_N, const math::Vector3& push_W);

}  // namespace rockyard::terrain
