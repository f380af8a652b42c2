#include "terrain/rock_holding_params.h"

namespace rockyard::terrain {

using core::Origin;

void RockHoldingParams::Visit(core::FieldVisitor& v) {
  v.Real("rock_density_kg_m3", rock_density_kg_m3,
         {.doc = "movable: density of the rocks",
          .min = 100.0,
          .max = 10000.0,
          .origin = Origin::kAssumed,
          .source = "solid andesite or basalt; vesicular rocks are lighter",
          .study_low = 2300.0,
          .study_high = 3000.0});
  v.Real("soil_density_kg_m3", soil_density_kg_m3,
         {.doc = "movable: density of the soil that a rock pushes ahead",
          .min = 100.0,
          .max = 4000.0,
          .origin = Origin::kAssumed,
          .source = "dry sand, loose to dense",
          .study_low = 1400.0,
          .study_high = 1800.0});
  v.Angle("soil_friction_angle_deg", soil_friction_angle_rad,
          {.doc = "movable: angle of internal friction of that soil, without cohesion",
           .min = 0.0,
           .max = 60.0,
           .origin = Origin::kAssumed,
           .source = "dry sand, loose to dense",
           .study_low = 30.0,
           .study_high = 40.0});
  v.Real("rock_soil_friction", rock_soil_friction,
         {.doc = "movable: friction between a rock and the soil under it",
          .min = 0.0,
          .max = 2.0,
          .origin = Origin::kAssumed,
          .source = "rough rock on sand, somewhat below the soil's own friction of 0.7",
          .study_low = 0.4,
          .study_high = 0.8});
}

}  // namespace rockyard::terrain
