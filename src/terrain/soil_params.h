// What the soil between the rocks does to a wheel: which law says it, and the quantities of the
// soil. rover/wheel_rut_params.h, wheel_soil.h and rim_stress_params.h have the equations. Both
// fidelities of the rover drive on them: the record of every drive depends on the values of its
// preset.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::terrain {

enum class SoilPreset {
  kLandscapingSand,
  kMarsDrift,
  kHardGround,
  kSojournerSoil,
  kSojournerDrift,
  kGrc1
};

// The law of a wheel on soil: Bekker 1969 with Janosi and Hanamoto 1961 (rover/wheel_rut_params.h),
// or stresses over the rim (rover/rim_stress_params.h).
enum class WheelLaw { kBekker, kWongReece, kResistiveForce, kIntrusion };

// Where the pressure under a sinking wheel comes from, for laws of stresses: plates, or the density
// and friction of a granular soil.
enum class SoilPressure { kPlate, kDensity };

// How slipping wheels dig in; rover/wheel_rut_params.h has Bekker's law, in which they do so where
// enabled. By laws of stresses they always do.
struct SlipSinkageParams {
  bool enabled = false;
  double exponent_per_slip = 0.5;
  double length_m = 0.1;

  void Visit(core::FieldVisitor& v);
  bool operator==(const SlipSinkageParams&) const = default;
};

// How far the soil of one place lies from what is said of it: standard deviations.
struct SoilSpreadParams {
  bool enabled = false;
  double friction_angle_rad = math::DegToRad(2.0);
  double exponent = 0.0;
  // Of natural logarithms.
  double log_modulus = 0.25;
  double log_cohesion = 0.5;
  double log_shear_modulus = 0.5;
  double log_density = 0.04;

  void Visit(core::FieldVisitor& v);
  bool operator==(const SoilSpreadParams&) const = default;
};

// The defaults are landscaping_sand: MakeSoil returns them for that preset.
struct SoilParams {
  SoilPreset preset = SoilPreset::kLandscapingSand;
  WheelLaw law = WheelLaw::kIntrusion;
  SoilPressure pressure = SoilPressure::kPlate;
  double sinkage_exponent = 0.79;
  double cohesive_modulus_N_per_mn1 = 102e3;
  double frictional_modulus_N_per_mn2 = 5301e3;
  double cohesion_Pa = 1300.0;
  double friction_angle_rad = math::DegToRad(31.1);
  double shear_modulus_m = 0.004;
  double density_kg_m3 = 1600.0;
  SlipSinkageParams slip_sinkage{};
  SoilSpreadParams spread{};

  // Visits the preset first: another preset replaces the defaults of the values that follow, which
  // the same file may then state; slip_sinkage and spread stay.
  void Visit(core::FieldVisitor& v);
  bool operator==(const SoilParams&) const = default;
};

// Returns the values of a preset.
SoilParams MakeSoil(SoilPreset preset);

}  // namespace rockyard::terrain

template <>
struct rockyard::core::EnumNames<rockyard::terrain::SoilPreset> {
  static constexpr std::array<std::string_view, 6> kNames{"landscaping_sand", "mars_drift",
                                                          "hard_ground",      "sojourner_soil",
                                                          "sojourner_drift",  "grc_1"};
};

template <>
struct rockyard::core::EnumNames<rockyard::terrain::WheelLaw> {
  static constexpr std::array<std::string_view, 4> kNames{"bekker", "wong_reece", "resistive_force",
                                                          "intrusion"};
};

template <>
struct rockyard::core::EnumNames<rockyard::terrain::SoilPressure> {
  static constexpr std::array<std::string_view, 2> kNames{"plate", "density"};
};
