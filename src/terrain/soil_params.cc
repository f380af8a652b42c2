#include "terrain/soil_params.h"

namespace rockyard::terrain {
namespace {

using core::Origin;

// Pressure against sinkage (Bekker).
void VisitSinkage(SoilParams& p, core::FieldVisitor& v) {
  v.Real(
      "sinkage_exponent", p.sinkage_exponent,
      {.doc = "exponent n of pressure against sinkage, p = (k_c / b + k_phi) z^n (Bekker)",
       .min = 0.1,
       .max = 2.0,
       .origin = Origin::kAssumed,
       .source = "landscaping_sand 0.79: LETE sand, Wong 2008 table 2.3; mars_drift 1.1, assumed: "
                 "loose dry sand, same table; hard_ground 1, assumed",
       .study_low = 0.7,
       .study_high = 1.1});
  v.Real("cohesive_modulus_N_per_mn1", p.cohesive_modulus_N_per_mn1,
         {.doc = "k_c of the same law",
          .min = 0.0,
          .max = 1e9,
          .origin = Origin::kAssumed,
          .source =
              "landscaping_sand 102e3: LETE sand, Wong 2008 table 2.3; mars_drift 0.99e3, assumed: "
              "loose dry sand, same table; hard_ground 0, assumed",
          .study_low = 0.0,
          .study_high = 102e3});
  v.Real("frictional_modulus_N_per_mn2", p.frictional_modulus_N_per_mn2,
         {.doc = "k_phi of the same law",
          .min = 1e3,
          .max = 1e14,
          .origin = Origin::kAssumed,
          .source = "landscaping_sand 5301e3: LETE sand, Wong 2008 table 2.3; mars_drift 1528e3, "
                    "assumed: loose dry sand, same table; hard_ground 1e11, assumed",
          .study_low = 1500e3,
          .study_high = 10000e3});
}

// Strength in shear (Mohr-Coulomb) and how it builds up (Janosi and Hanamoto).
void VisitShear(SoilParams& p, core::FieldVisitor& v) {
  v.Real("cohesion_Pa", p.cohesion_Pa,
         {.doc = "cohesion c of the soil in shear (Mohr-Coulomb)",
          .min = 0.0,
          .max = 1e6,
          .origin = Origin::kAssumed,
          .source =
              "landscaping_sand 1.3 kPa: LETE sand, Wong 2008 table 2.3 (loose dry sand 1.04 kPa); "
              "mars_drift 1.6 kPa: drift at Viking 1, Moore et al. 1987; hard_ground 0, assumed",
          .study_low = 0.0,
          .study_high = 1500.0});
  v.Angle(
      "friction_angle_deg", p.friction_angle_rad,
      {.doc = "angle of internal shearing resistance phi (Mohr-Coulomb)",
       .min = 0.0,
       .max = 60.0,
       .origin = Origin::kAssumed,
       .source =
           "landscaping_sand 31.1: LETE sand, Wong 2008 table 2.3 (loose dry sand 28, dense sand "
           "to 38); mars_drift 18: drift at Viking 1, Moore et al. 1987; hard_ground 38.66, "
           "assumed",
       .study_low = 28.0,
       .study_high = 38.0});
  v.Real("shear_modulus_m", p.shear_modulus_m,
         {.doc = "shear deformation modulus K of Janosi and Hanamoto 1961; 0: no slip below the "
                 "largest traction",
          .min = 0.0,
          .max = 0.2,
          .origin = Origin::kAssumed,
          .source =
              "landscaping_sand 4 mm, assumed: cleats as high as the wheel sinks mobilize the sand "
              "ahead of them within a few mm; mars_drift 10 mm, assumed: the low end of plates on "
              "sand, "
              "10 to 25 mm (Wong 2008 sec. 2.4); hard_ground 0, assumed. Studied from a cleat's "
              "few mm "
              "to the most that plates show",
          .study_low = 0.002,
          .study_high = 0.025});
}

}  // namespace

void SlipSinkageParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            {.doc = "wheels that slip dig in: the exponent of pressure against sinkage grows with "
                    "the slip, n = n_0 + n_1 i (Ding et al. 2010)",
             .origin = Origin::kSetting});
  v.Real("exponent_per_slip", exponent_per_slip,
         {.doc = "n_1, what a slip of 1 adds to the sinkage exponent",
          .min = 0.0,
          .max = 0.9,
          .origin = Origin::kAssumed,
          .source = "Ding et al. 2010 measured 3 to 7 times the static sinkage at a slip of 0.6: "
                    "0.4 to 0.83 do that to a wheel that sinks 1.5 mm (Rocky 3.2 on "
                    "landscaping_sand), and less to one that sinks deeper",
          .study_low = 0.4,
          .study_high = 0.83});
  v.Real("length_m", length_m,
         {.doc = "way that the rim slides over the soil, or rolls out of its hole, within which "
                 "the sinkage comes to 63 % of the one that belongs to the slip",
          .min = 1e-3,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "no measurement known: between a contact length and a turn of the wheel of "
                    "Rocky 3.2, 1.4 and 41 cm",
          .study_low = 0.02,
          .study_high = 0.4});
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
           {.doc = "soil whose values the rest starts from",
            .origin = Origin::kSetting,
            .source = "the arena held landscaping sand with crushed brick (Matthies 1995 sec. 2)"});
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
