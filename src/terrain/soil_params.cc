#include "terrain/soil_params.h"

namespace rockyard::terrain {
namespace {

using core::Assumed;
using core::Setting;

// Pressure against sinkage (Bekker).
void VisitSinkage(SoilParams& p, core::FieldVisitor& v) {
  v.Real("sinkage_exponent", p.sinkage_exponent,
         Assumed("exponent n of pressure against sinkage, p = (k_c / b + k_phi) z^n (Bekker)",
                 "landscaping_sand 0.79: LETE sand, Wong 2008 table 2.3; mars_drift 1.1, assumed: "
                 "loose dry sand, same table; hard_ground 1, assumed",
                 {0.1, 2.0}, {0.7, 1.1}));
  v.Real("cohesive_modulus_N_per_mn1", p.cohesive_modulus_N_per_mn1,
         Assumed("k_c of the same law",
                 "landscaping_sand 102e3: LETE sand, Wong 2008 table 2.3; mars_drift 0.99e3, "
                 "assumed: loose dry sand, same table; hard_ground 0, assumed",
                 {0.0, 1e9}, {0.0, 102e3}));
  v.Real("frictional_modulus_N_per_mn2", p.frictional_modulus_N_per_mn2,
         Assumed("k_phi of the same law",
                 "landscaping_sand 5301e3: LETE sand, Wong 2008 table 2.3; mars_drift 1528e3, "
                 "assumed: loose dry sand, same table; hard_ground 1e11, assumed",
                 {1e3, 1e14}, {1500e3, 10000e3}));
}

// Strength in shear (Mohr-Coulomb) and how it builds up (Janosi and Hanamoto).
void VisitShear(SoilParams& p, core::FieldVisitor& v) {
  v.Real(
      "cohesion_Pa", p.cohesion_Pa,
      Assumed("cohesion c of the soil in shear (Mohr-Coulomb)",
              "landscaping_sand 1.3 kPa: LETE sand, Wong 2008 table 2.3 (loose dry sand 1.04 kPa); "
              "mars_drift 1.6 kPa: drift at Viking 1, Moore et al. 1987; hard_ground 0, assumed",
              {0.0, 1e6}, {0.0, 1500.0}));
  v.Angle(
      "friction_angle_deg", p.friction_angle_rad,
      Assumed(
          "angle of internal shearing resistance phi (Mohr-Coulomb)",
          "landscaping_sand 31.1: LETE sand, Wong 2008 table 2.3 (loose dry sand 28, dense sand to "
          "38); mars_drift 18: drift at Viking 1, Moore et al. 1987; hard_ground 38.66, assumed",
          {0.0, 60.0}, {28.0, 38.0}));
  v.Real("shear_modulus_m", p.shear_modulus_m,
         Assumed("shear deformation modulus K of Janosi and Hanamoto 1961; 0: no slip below the "
                 "largest traction",
                 "landscaping_sand 4 mm, assumed: cleats as high as the wheel sinks mobilize the "
                 "sand ahead of them within a few mm; mars_drift 10 mm, assumed: the low end of "
                 "plates on sand, 10 to 25 mm (Wong 2008 sec. 2.4); hard_ground 0, assumed. "
                 "Studied from a cleat's few mm to the most that plates show",
                 {0.0, 0.2}, {0.002, 0.025}));
}

}  // namespace

void SlipSinkageParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("wheels that slip dig in: the exponent of pressure against sinkage grows with "
                    "the slip, n = n_0 + n_1 i (Ding et al. 2010)"));
  v.Real("exponent_per_slip", exponent_per_slip,
         Assumed("n_1, what a slip of 1 adds to the sinkage exponent",
                 "Ding et al. 2010 measured 3 to 7 times the static sinkage at a slip of 0.6: 0.4 "
                 "to 0.83 do that to a wheel that sinks 1.5 mm (Rocky 3.2 on landscaping_sand), "
                 "and less to one that sinks deeper",
                 {0.0, 0.9}, {0.4, 0.83}));
  v.Real("length_m", length_m,
         Assumed("way that the rim slides over the soil, or rolls out of its hole, within which "
                 "the sinkage comes to 63 % of the one that belongs to the slip",
                 "no measurement known: between a contact length and a turn of the wheel of Rocky "
                 "3.2, 1.4 and 41 cm",
                 {1e-3, 10.0}, {0.02, 0.4}));
}

SoilParams MakeSoil(SoilPreset preset) {
  switch (preset) {
    case SoilPreset::kLandscapingSand:
      break;
    case SoilPreset::kMarsDrift:
      // Strength of the drift material at the Viking 1 site (Moore et al. 1987: 1.6 kPa, 18 deg);
      // pressure-sinkage of loose dry sand (Wong 2008 table 2.3, Land Locomotion Laboratory),
      // since nobody has pressed a plate into it.
      return {preset, 1.1, 0.99e3, 1528.43e3, 1600.0, math::DegToRad(18.0), 0.010, {}};
    case SoilPreset::kHardGround:
      // Coulomb friction of 0.8 and next to no sinkage: a wheel of 30 N sinks by some 10 um.
      return {preset, 1.0, 0.0, 1e11, 0.0, math::DegToRad(38.66), 0.0, {}};
  }
  return {};
}

void SoilParams::Visit(core::FieldVisitor& v) {
  const SoilPreset before = preset;
  v.Choice("preset", preset,
           Setting("soil whose values the rest starts from", {},
                   "the arena held landscaping sand with crushed brick (Matthies 1995 sec. 2)"));
  if (preset != before) {
    const SlipSinkageParams kept = slip_sinkage;
    *this = MakeSoil(preset);
    slip_sinkage = kept;
  }
  VisitSinkage(*this, v);
  VisitShear(*this, v);
  v.Group("slip_sinkage", slip_sinkage, "wheels that slip dig in");
}

}  // namespace rockyard::terrain
