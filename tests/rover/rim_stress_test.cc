// Stresses over the rim: closed forms, published functions, and what all laws owe to energy.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "law_cases.h"
#include "rover/rim_stress_params.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

using terrain::SoilPressure;
using terrain::WheelLaw;

// Pressure per depth of a granular soil (Agarwal, Goldman and Kamrin 2023).
double GranularModulus(const terrain::SoilParams& soil) {
  const double mu = std::tan(soil.friction_angle_rad);
  return soil.density_kg_m3 * kLabGravity_m_s2 *
         (894.0 * mu * mu * mu - 386.0 * mu * mu + 89.0 * mu);
}

// Soil that bears by nothing but its cohesion, c over all of the arc.
TEST(RimStressLaw, CohesionAloneHasItsClosedForm) {
  terrain::SoilParams soil = SoilOf({WheelLaw::kWongReece, SoilPressure::kPlate});
  soil.cohesive_modulus_N_per_mn1 = soil.frictional_modulus_N_per_mn2 = 0.0;
  soil.shear_modulus_m = 0.0;
  soil.cohesion_Pa = 1000.0;
  const double arc_N = 1000.0 * kSmooth.radius_m * kSmooth.width_m;
  for (const double entry_rad : {0.2, 0.7, 1.4}) {
    const RimForces forces = RimStress(soil, kSmooth, kLabGravity_m_s2).At(entry_rad, 0.3);
    EXPECT_NEAR(forces.load_N, arc_N * (1.0 - std::cos(entry_rad)), 1e-3 * arc_N);
    EXPECT_NEAR(forces.pull_N, arc_N * std::sin(entry_rad), 1e-3 * arc_N);
    EXPECT_NEAR(forces.gross_N, arc_N * entry_rad, 1e-12 * arc_N);
  }
}

// Without friction, for a small entry angle t and n = 1, with m the peak's share of it:
//   W = k b r^2 t^3 / 2 (1 - (1 + m + m^2) / 3), since the arc behind the peak mirrors the one
//   ahead.
TEST(RimStressLaw, WongAndReecesLoadWithoutFrictionHasItsClosedForm) {
  terrain::SoilParams soil = SoilOf({WheelLaw::kWongReece, SoilPressure::kPlate});
  soil.sinkage_exponent = 1.0;
  soil.friction_angle_rad = 0.0;
  const double entry_rad = 0.05;
  const double modulus_N_m2 =
      soil.cohesive_modulus_N_per_mn1 + kSmooth.width_m * soil.frictional_modulus_N_per_mn2;
  for (const double slip : {0.0, 0.3, 0.9}) {
    const double m = 0.18 + 0.32 * slip;
    const double expected_N = modulus_N_m2 * kSmooth.radius_m * kSmooth.radius_m *
                              std::pow(entry_rad, 3) / 2.0 * (1.0 - (1.0 + m + m * m) / 3.0);
    const RimForces forces = RimStress(soil, kSmooth, kLabGravity_m_s2).At(entry_rad, slip);
    EXPECT_NEAR(forces.load_N, expected_N, 4e-3 * expected_N) << slip;
    EXPECT_EQ(forces.gross_N, 0.0);
    EXPECT_LT(forces.pull_N, 0.0);
  }
}

// The functions of tilt and direction as they are published (Li, Zhang and Goldman 2013, table S3),
// added up over the rim.
TEST(RimStressLaw, ResistiveForceIsThatOfThePublishedFunctions) {
  const terrain::SoilParams soil = SoilOf({WheelLaw::kResistiveForce, SoilPressure::kDensity});
  const RimStress stress(soil, kSmooth, kLabGravity_m_s2);
  const double r = kSmooth.radius_m;
  for (const double entry_rad : {0.4, 1.1}) {
    for (const double slip : {-0.4, 0.0, 0.2, 0.8}) {
      const double rim = slip >= 0.0 ? 1.0 / (1.0 - slip) : 1.0 + slip;
      const auto integral = [&](bool upward) {
        return Integrate(entry_rad, [&](double angle) {
          // Where the rim moves back, the mirror image of one that moves forward.
          const double forward = 1.0 - rim * std::cos(angle);
          const double sign = forward >= 0.0 ? 1.0 : -1.0;
          const double b = sign * angle;
          const double g = std::atan2(rim * std::sin(angle), std::abs(forward));
          const double alpha_z = 0.206 + 0.169 * std::cos(2 * b) + 0.212 * std::sin(2 * b + g) +
                                 0.358 * std::sin(g) + 0.055 * std::sin(-2 * b + g);
          const double alpha_x = -0.124 * std::cos(2 * b + g) + 0.253 * std::cos(g) +
                                 0.007 * std::cos(-2 * b + g) + 0.088 * std::sin(2 * b);
          const double pressure_Pa =
              GranularModulus(soil) * r * (std::cos(angle) - std::cos(entry_rad));
          return r * kSmooth.width_m * pressure_Pa * (upward ? alpha_z : -sign * alpha_x);
        });
      };
      const RimForces forces = stress.At(entry_rad, slip);
      EXPECT_NEAR(forces.load_N, integral(true), 2e-3 * forces.load_N) << entry_rad << " " << slip;
      EXPECT_NEAR(forces.pull_N, integral(false), 4e-3 * forces.load_N) << entry_rad << " " << slip;
    }
  }
}

// A rim that hardly sinks and spins is a level plate that slides: shear over pressure is the ratio
// of the published coefficients, or friction at the rim.
TEST(RimStressLaw, ASpinningRimSlidesLikeALevelPlate) {
  const auto ratio = [](WheelLaw law, const RimShape& wheel) {
    const RimForces forces =
        RimStress(SoilOf({law, SoilPressure::kDensity}), wheel, kLabGravity_m_s2).At(1e-3, 0.999);
    return forces.gross_N / forces.load_N;
  };
  const double phi = math::DegToRad(32.0);
  EXPECT_NEAR(ratio(WheelLaw::kResistiveForce, kSmooth), 0.136 / 0.375, 2e-3);
  EXPECT_NEAR(ratio(WheelLaw::kIntrusion, kSmooth), std::tan(2.0 * phi / 3.0), 2e-3);
  EXPECT_NEAR(ratio(WheelLaw::kIntrusion, kLugged), std::sin(phi), 2e-3);
  RimShape half = kLugged;  // lugs whose soil covers half of the rim
  half.lug_count = 1;
  half.lug_height_m = std::numbers::pi * half.radius_m / 5.0;
  EXPECT_NEAR(ratio(WheelLaw::kIntrusion, half), 0.5 * (std::sin(phi) + std::tan(2.0 * phi / 3.0)),
              2e-3);
}

// 0.37 xi z over the segment of the side face below the surface: for a small entry angle t
// 0.37 xi r^3 2/15 t^5. So it vanishes with the sinkage, even over the load.
TEST(RimStressLaw, TheSideForceIsThatOfAnUprightPlate) {
  for (const WheelLaw law : {WheelLaw::kResistiveForce, WheelLaw::kIntrusion}) {
    const terrain::SoilParams soil = SoilOf({law, SoilPressure::kDensity});
    const RimStress stress(soil, kSmooth, kLabGravity_m_s2);
    const double expected_N = 0.37 * GranularModulus(soil) * std::pow(kSmooth.radius_m, 3) * 2.0 /
                              15.0 * std::pow(0.05, 5);
    EXPECT_NEAR(stress.At(0.05, 0.2).side_N, expected_N, 4e-3 * expected_N);
    const RimForces barely = stress.At(0.004, 0.2);
    EXPECT_LT(barely.side_N, 1e-4 * barely.load_N);
  }
}

TEST(RimStressLaw, ForcesOfACohesionlessSoilGoWithItsDensityAndGravity) {
  for (const WheelLaw law :
       {WheelLaw::kWongReece, WheelLaw::kResistiveForce, WheelLaw::kIntrusion}) {
    terrain::SoilParams soil = SoilOf({law, SoilPressure::kDensity});
    const RimForces base = RimStress(soil, kLugged, kLabGravity_m_s2).At(0.6, 0.25);
    soil.density_kg_m3 *= 1.25;
    const RimForces both = RimStress(soil, kLugged, 2.0 * kLabGravity_m_s2).At(0.6, 0.25);
    EXPECT_NEAR(both.load_N, 2.5 * base.load_N, 1e-9 * base.load_N);
    EXPECT_NEAR(both.pull_N, 2.5 * base.pull_N, 1e-9 * base.load_N);
    EXPECT_NEAR(both.gross_N, 2.5 * base.gross_N, 1e-9 * base.load_N);
    EXPECT_NEAR(both.side_N, 2.5 * base.side_N, 1e-9 * base.load_N);
  }
}

// The motor gives at least the work that the carriage gets: soil gives none.
TEST(RimStressLaw, NoWheelGivesMoreWorkThanItTakes) {
  for (const LawCase& kind : kStressLaws) {
    for (const RimShape& wheel : {kSmooth, kLugged}) {
      const RimStress stress(SoilOf(kind), wheel, kLabGravity_m_s2);
      for (int k = -19; k <= 19; ++k) {
        const double slip = 0.05 * k;
        const double rim = slip >= 0.0 ? 1.0 : 1.0 + slip;
        const double travel = slip >= 0.0 ? 1.0 - slip : 1.0;
        for (double entry_rad = 0.05; entry_rad < 1.5; entry_rad += 0.1) {
          const RimForces forces = stress.At(entry_rad, slip);
          EXPECT_GE(forces.gross_N * rim, forces.pull_N * travel)
              << static_cast<int>(kind.law) << " slip " << slip << " entry " << entry_rad;
        }
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::rover
