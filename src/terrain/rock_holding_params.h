// Parameters of what holds a movable rock in the soil.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::terrain {

// The values that terrain/rock_holding.h asks for.
struct RockHoldingParams {
  double rock_density_kg_m3 = 2700.0;
  double soil_density_kg_m3 = 1600.0;
  double soil_friction_angle_rad = math::DegToRad(35.0);
  double rock_soil_friction = 0.6;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::terrain
