#include "terrain/soil_params.h"

namespace rockyard::terrain {
namespace {

using core::Assumed;
using core::Setting;

// Which law takes the quantities below.
void VisitLaw(SoilParams& p, core::FieldVisitor& v) {
  v.Choice("law", p.law,
           Assumed("law of a wheel on soil: bekker, a rut by its load and Janosi and Hanamoto's "
                   "traction; wong_reece, stresses over the rim; resistive_force, granular "
                   "resistive force theory; intrusion, its pressure with friction at the rim",
                   "judged on wheels that no law was fitted to: results/wheel_soil.md"));
  v.Choice(
      "pressure", p.pressure,
      Assumed(
          "pressure under a sinking wheel, not for bekker: plate, by exponent and moduli; "
          "density, of a granular soil by density, friction angle and gravity",
          "plates where soil was pressed; density, for sojourner_soil, sojourner_drift and grc_1, "
          "where only that is known"));
  v.Real(
      "density_kg_m3", p.density_kg_m3,
      Assumed(
          "bulk density, with pressure density",
          "landscaping_sand 1600, mars_drift 1150, both unmeasured: dry sand, loose 1450 to dense "
          "1750, drift lighter; sojourner_soil 1550 and sojourner_drift 1250, of the soils "
          "that Sojourner dug into as others quote Moore et al. 1999; grc_1 1660, the "
          "loosest of three pairs of density and friction angle (Hu et al. 2024)",
          {100.0, 5000.0}, {1450.0, 1750.0}));
}

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
              "mars_drift 1.6 kPa: drift at Viking 1, Moore et al. 1987; hard_ground 0, assumed; "
              "sojourner_soil 0.24 and sojourner_drift 0.3 kPa as others quote Moore et al. 1999; "
              "grc_1 0, a simulant of washed sands",
              {0.0, 1e6}, {0.0, 1500.0}));
  v.Angle(
      "friction_angle_deg", p.friction_angle_rad,
      Assumed(
          "angle of internal shearing resistance phi (Mohr-Coulomb)",
          "landscaping_sand 31.1: LETE sand, Wong 2008 table 2.3 (loose dry sand 28, dense sand to "
          "38); mars_drift 18: drift at Viking 1, Moore et al. 1987; hard_ground 38.66, assumed; "
          "sojourner_soil 36.5 (34 to 39) and sojourner_drift 27 (26 to 28), Moore et al. 1999 as "
          "others quote it; grc_1 33.4 (Hu et al. 2024)",
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

// A soil of which strength and density are known: its pressure is that of a granular soil.
SoilParams Granular(SoilPreset preset, double density_kg_m3, double friction_deg,
                    double cohesion_Pa) {
  SoilParams soil;
  soil.preset = preset;
  soil.pressure = SoilPressure::kDensity;
  soil.density_kg_m3 = density_kg_m3;
  soil.friction_angle_rad = math::DegToRad(friction_deg);
  soil.cohesion_Pa = cohesion_Pa;
  // Without plates: Bekker's law takes those of loose dry sand, as for mars_drift.
  soil.sinkage_exponent = 1.1;
  soil.cohesive_modulus_N_per_mn1 = 0.99e3;
  soil.frictional_modulus_N_per_mn2 = 1528.43e3;
  soil.shear_modulus_m = 0.010;
  return soil;
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

void SoilSpreadParams::Visit(core::FieldVisitor& v) {
  constexpr std::string_view kScatter =
      "no statistics of one place known: about what presets for one kind of sand differ by";
  v.Boolean("enabled", enabled,
            Setting("each trial draws its soil about the values above; exponent and friction angle "
                    "normal, the others log-normal"));
  v.Angle("friction_angle_deg", friction_angle_rad,
          Assumed("standard deviation of the friction angle",
                  "sets of one simulant by its density differ by 5 deg (GRC-1: 33.4 to 38.4)",
                  {0.0, 20.0}, {1.0, 4.0}));
  v.Real(
      "exponent", exponent,
      Assumed("standard deviation of the sinkage exponent",
              "what nine plate tests on one bed of sand scatter by, 0.09, goes with their moduli",
              {0.0, 1.0}, {0.0, 0.09}));
  v.Real("log_modulus", log_modulus,
         Assumed("standard deviation of the logarithm of both moduli",
                 "pressure 10 mm deep in nine plate tests on one bed of sand (Pavlov, CMU)",
                 {0.0, 3.0}, {0.2, 0.6}));
  v.Real("log_cohesion", log_cohesion,
         Assumed("standard deviation of the logarithm of the cohesion", kScatter, {0.0, 3.0},
                 {0.3, 1.0}));
  v.Real("log_shear_modulus", log_shear_modulus,
         Assumed("standard deviation of the logarithm of the shear modulus", kScatter, {0.0, 3.0},
                 {0.2, 0.8}));
  v.Real("log_density", log_density,
         Assumed("standard deviation of the logarithm of the density", kScatter, {0.0, 1.0},
                 {0.02, 0.06}));
}

SoilParams MakeSoil(SoilPreset preset) {
  SoilParams soil;
  soil.preset = preset;
  switch (preset) {
    case SoilPreset::kLandscapingSand:
      break;
    case SoilPreset::kMarsDrift:
      // Strength of the drift material at the Viking 1 site (Moore et al. 1987: 1.6 kPa, 18 deg);
      // pressure-sinkage of loose dry sand (Wong 2008 table 2.3, Land Locomotion Laboratory),
      // since nobody has pressed a plate into it.
      soil.sinkage_exponent = 1.1;
      soil.cohesive_modulus_N_per_mn1 = 0.99e3;
      soil.frictional_modulus_N_per_mn2 = 1528.43e3;
      soil.cohesion_Pa = 1600.0;
      soil.friction_angle_rad = math::DegToRad(18.0);
      soil.shear_modulus_m = 0.010;
      soil.density_kg_m3 = 1150.0;
      break;
    case SoilPreset::kHardGround:
      // Coulomb friction of 0.8 and next to no sinkage: a wheel of 30 N sinks by some 10 um.
      soil.law = WheelLaw::kBekker;
      soil.sinkage_exponent = 1.0;
      soil.cohesive_modulus_N_per_mn1 = 0.0;
      soil.frictional_modulus_N_per_mn2 = 1e11;
      soil.cohesion_Pa = 0.0;
      soil.friction_angle_rad = math::DegToRad(38.66);
      soil.shear_modulus_m = 0.0;
      break;
    case SoilPreset::kSojournerSoil:
      return Granular(preset, 1550.0, 36.5, 240.0);
    case SoilPreset::kSojournerDrift:
      return Granular(preset, 1250.0, 27.0, 300.0);
    case SoilPreset::kGrc1:
      return Granular(preset, 1660.0, 33.4, 0.0);
  }
  return soil;
}

void SoilParams::Visit(core::FieldVisitor& v) {
  const SoilPreset before = preset;
  v.Choice("preset", preset,
           Setting("soil whose values the rest starts from", {},
                   "the arena held landscaping sand with crushed brick (Matthies 1995 sec. 2)"));
  if (preset != before) {
    const SlipSinkageParams kept = slip_sinkage;
    const SoilSpreadParams kept_spread = spread;
    *this = MakeSoil(preset);
    slip_sinkage = kept;
    spread = kept_spread;
  }
  VisitLaw(*this, v);
  VisitSinkage(*this, v);
  VisitShear(*this, v);
  v.Group("slip_sinkage", slip_sinkage, "wheels that slip dig in");
  v.Require("slip_sinkage.enabled", !slip_sinkage.enabled || law == WheelLaw::kBekker,
            "is part of the law bekker, and law is another",
            "set law to bekker, or leave slip_sinkage out: by the other laws wheels that slip dig "
            "in without it");
  v.Group("spread", spread, "the soil differs from trial to trial");
}

}  // namespace rockyard::terrain
