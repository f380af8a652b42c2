// Wheels and soils that the tests of laws of a wheel share.
#pragma once

#include "rover/rim_stress_params.h"
#include "terrain/soil_params.h"

namespace rockyard::rover {

inline constexpr double kLabGravity_m_s2 = 9.81;
inline constexpr RimShape kSmooth{.radius_m = 0.15, .width_m = 0.12};
// Lugs closer than five heights: they hold all of the soil between them.
inline constexpr RimShape kLugged{
    .radius_m = 0.15, .width_m = 0.12, .lug_height_m = 0.01, .lug_count = 20};

struct LawCase {
  terrain::WheelLaw law;
  terrain::SoilPressure pressure;
};
inline constexpr LawCase kStressLaws[] = {
    {terrain::WheelLaw::kWongReece, terrain::SoilPressure::kPlate},
    {terrain::WheelLaw::kWongReece, terrain::SoilPressure::kDensity},
    {terrain::WheelLaw::kResistiveForce, terrain::SoilPressure::kPlate},
    {terrain::WheelLaw::kResistiveForce, terrain::SoilPressure::kDensity},
    {terrain::WheelLaw::kIntrusion, terrain::SoilPressure::kPlate},
    {terrain::WheelLaw::kIntrusion, terrain::SoilPressure::kDensity}};

inline terrain::SoilParams SoilOf(const LawCase& kind) {
  terrain::SoilParams soil;
  soil.law = kind.law;
  soil.pressure = kind.pressure;
  soil.sinkage_exponent = 1.1;
  soil.cohesive_modulus_N_per_mn1 = 15.6e3;
  soil.frictional_modulus_N_per_mn2 = 2407e3;
  soil.cohesion_Pa = 0.0;
  soil.friction_angle_rad = math::DegToRad(32.0);
  soil.shear_modulus_m = 0.011;
  soil.density_kg_m3 = 1600.0;
  return soil;
}

}  // namespace rockyard::rover
