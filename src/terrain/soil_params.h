// What the soil between the rocks does to a wheel: the quantities of Bekker, Wong, and Janosi and
// Hanamoto. rover/wheel_rut_params.h and wheel_soil.h have the equations. Both fidelities of the
// rover drive on them: the record of every drive depends on the values of its preset.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::terrain {

enum class SoilPreset { kLandscapingSand, kMarsDrift, kHardGround };

// How slipping wheels dig in; rover/wheel_rut_params.h has the law.
struct SlipSinkageParams {
  bool enabled = false;
  double exponent_per_slip = 0.5;
  double length_m = 0.1;

  void Visit(core::FieldVisitor& v);
};

// The defaults are landscaping_sand: MakeSoil returns them for that preset.
struct SoilParams {
  SoilPreset preset = SoilPreset::kLandscapingSand;
  double sinkage_exponent = 0.79;
  double cohesive_modulus_N_per_mn1 = 102e3;
  double frictional_modulus_N_per_mn2 = 5301e3;
  double cohesion_Pa = 1300.0;
  double friction_angle_rad = math::DegToRad(31.1);
  double shear_modulus_m = 0.004;
  SlipSinkageParams slip_sinkage{};

  // Visits the preset first: another preset replaces the defaults of the values that follow, which
  // the same file may then state; slip_sinkage stays.
  void Visit(core::FieldVisitor& v);
};

// Returns the values of a preset.
SoilParams MakeSoil(SoilPreset preset);

}  // namespace rockyard::terrain

template <>
struct rockyard::core::EnumNames<rockyard::terrain::SoilPreset> {
  static constexpr std::array<std::string_view, 3> kNames{"landscaping_sand", "mars_drift",
                                                          "hard_ground"};
};
