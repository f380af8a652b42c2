// The wheel-soil model against hand values, its plain reference and its own inverses.
#include "rover/wheel_soil.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "rover/quasi_static/wheel_soil_table.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

constexpr double kRadius_m = 0.065;
constexpr double kWidth_m = 0.08;

std::vector<terrain::SoilParams> Presets() {
  return {terrain::MakeSoil(terrain::SoilPreset::kLandscapingSand),
          terrain::MakeSoil(terrain::SoilPreset::kMarsDrift),
          terrain::MakeSoil(terrain::SoilPreset::kHardGround)};
}

// Dry sand of the Land Locomotion Laboratory (Wong 2008 table 2.3) under a wheel of Rocky 3.2 with
// 30 N, by a desk calculator: b k = 990 + 0.08 * 1528430 = 123264.4,
//   z = (90 / (1.9 * 123264.4 * sqrt(0.13)))^(1 / 1.6), R = 123264.4 z^2.1 / 2.1,
//   l = 0.065 acos(1 - z / 0.065), T_max = 0.08 l 1040 + 30 tan(28 deg), u = 0.2 l / 0.01.
TEST(WheelSoil, HandValuesOfDrySand) {
  const terrain::SoilParams dry_sand{.sinkage_exponent = 1.1,
                                     .cohesive_modulus_N_per_mn1 = 0.99e3,
                                     .frictional_modulus_N_per_mn2 = 1528.43e3,
                                     .cohesion_Pa = 1040.0,
                                     .friction_angle_rad = math::DegToRad(28.0),
                                     .shear_modulus_m = 0.010};
  const WheelSoil soil(dry_sand, kRadius_m, kWidth_m);
  EXPECT_NEAR(soil.Sinkage_m(30.0), 0.013877, 1e-6);
  EXPECT_NEAR(soil.Resistance_N(30.0), 7.3697, 1e-3);
  EXPECT_NEAR(soil.ContactLength_m(30.0), 0.04327, 1e-5);
  EXPECT_NEAR(soil.LargestTraction_N(30.0), 19.5512, 1e-3);
  EXPECT_NEAR(soil.TractionShare(0.2, 30.0), 0.3308, 1e-4);
}

TEST(WheelSoil, AgreesWithItsPlainReference) {
  for (const terrain::SoilParams& params : Presets()) {
    const WheelSoil soil(params, kRadius_m, kWidth_m);
    const SoilReference reference{params, kRadius_m, kWidth_m};
    for (const double load_N : {0.5, 5.0, 30.0, 120.0}) {
      const Rut rut = soil.RutUnder(load_N);
      EXPECT_NEAR(rut.sinkage_m, reference.Sinkage(load_N), 1e-9 * kRadius_m);
      EXPECT_NEAR(rut.resistance_N / reference.Resistance(load_N), 1.0, 1e-5);
      EXPECT_NEAR(rut.contact_length_m / reference.ContactLength(load_N), 1.0, 1e-5);
      EXPECT_NEAR(rut.largest_traction_N / reference.LargestTraction(load_N), 1.0, 1e-6);
      for (const double slip : {0.01, 0.2, 1.0}) {
        EXPECT_NEAR(soil.TractionShare(slip, load_N), reference.Share(slip, load_N), 1e-6);
      }
    }
  }
}

TEST(WheelSoil, StiffnessIsTheDerivativeOfTheLoad) {
  for (const terrain::SoilParams& params : Presets()) {
    const WheelSoil soil(params, kRadius_m, kWidth_m);
    for (const double load_N : {0.5, 30.0, 120.0}) {
      const Rut rut = soil.RutUnder(load_N);
      EXPECT_NEAR(soil.Load_N(rut.sinkage_m) / load_N, 1.0, 1e-12);
      const double dz_m = 1e-4 * rut.sinkage_m;
      const double slope =
          (soil.Load_N(rut.sinkage_m + dz_m) - soil.Load_N(rut.sinkage_m - dz_m)) / (2.0 * dz_m);
      EXPECT_NEAR(rut.stiffness_N_m / slope, 1.0, 1e-6);
    }
  }
}

TEST(WheelSoil, SlipAndShareAreInverses) {
  const ShareTable shares;
  for (const terrain::SoilParams& params : Presets()) {
    if (params.shear_modulus_m == 0.0) continue;
    const WheelSoil soil(params, kRadius_m, kWidth_m);
    for (const double load_N : {1.0, 30.0}) {
      const Rut rut = soil.RutUnder(load_N);
      for (double slip = 1e-6; slip < 1.0; slip *= 1.7) {
        const double tau = soil.TractionShare(slip, load_N);
        EXPECT_NEAR(soil.Slip(tau, load_N) / slip, 1.0, 1e-7);
        // By a table, within 1e-7 of tau.
        EXPECT_NEAR(soil.SlipPerShare(slip, rut, shares) * tau / slip, 1.0, 2e-6);
      }
    }
  }
}

TEST(WheelSoil, EverythingGrowsWithLoadAndShare) {
  for (const terrain::SoilParams& params : Presets()) {
    const WheelSoil soil(params, kRadius_m, kWidth_m);
    for (double load_N = 0.1; load_N < 200.0; load_N *= 1.3) {
      const Rut rut = soil.RutUnder(load_N);
      const Rut more = soil.RutUnder(1.3 * load_N);
      EXPECT_GT(more.sinkage_m, rut.sinkage_m);
      EXPECT_GT(more.resistance_N, rut.resistance_N);
      EXPECT_GT(more.contact_length_m, rut.contact_length_m);
      EXPECT_GT(more.largest_traction_N, rut.largest_traction_N);
    }
    double last = 0.0;
    for (double tau = 0.01; tau < 1.0; tau += 0.01) {
      EXPECT_GE(soil.Slip(tau, 30.0), last);
      last = soil.Slip(tau, 30.0);
    }
  }
}

TEST(WheelSoil, Limits) {
  for (const terrain::SoilParams& params : Presets()) {
    const WheelSoil soil(params, kRadius_m, kWidth_m);
    EXPECT_EQ(soil.Sinkage_m(0.0), 0.0);
    EXPECT_EQ(soil.Load_N(0.0), 0.0);
    EXPECT_EQ(soil.Resistance_N(0.0), 0.0);
    EXPECT_EQ(soil.ContactLength_m(0.0), 0.0);
    EXPECT_EQ(soil.LargestTraction_N(0.0), 0.0);
    EXPECT_EQ(soil.Slip(0.0, 30.0), 0.0);
    EXPECT_EQ(soil.Slip(1.0, 30.0), 1.0);
    EXPECT_EQ(soil.Slip(2.0, 30.0), 1.0);
    EXPECT_EQ(soil.TractionShare(0.0, 30.0), 0.0);
    // A wheel deeper than itself has no rim above the soil.
    EXPECT_LE(soil.ContactLength_m(1e9), std::numbers::pi * kRadius_m + 1e-12);
    // Small slip: tau = u / 2.
    const Rut rut = soil.RutUnder(30.0);
    EXPECT_NEAR(soil.SlipPerShare(0.0, rut, ShareTable()),
                2.0 * params.shear_modulus_m / rut.contact_length_m, 1e-12);
  }
}

TEST(WheelSoil, PresetsDifferAsTheirNamesSay) {
  const auto sinkage_m = [](terrain::SoilPreset preset) {
    return WheelSoil(terrain::MakeSoil(preset), kRadius_m, kWidth_m).Sinkage_m(30.0);
  };
  EXPECT_LT(sinkage_m(terrain::SoilPreset::kHardGround), 2e-5);
  EXPECT_GT(sinkage_m(terrain::SoilPreset::kLandscapingSand), 5e-4);
  EXPECT_GT(sinkage_m(terrain::SoilPreset::kMarsDrift),
            3.0 * sinkage_m(terrain::SoilPreset::kLandscapingSand));
  const WheelSoil hard(terrain::MakeSoil(terrain::SoilPreset::kHardGround), kRadius_m, kWidth_m);
  EXPECT_NEAR(hard.LargestTraction_N(30.0), 0.8 * 30.0, 0.01);
  EXPECT_EQ(hard.Slip(0.99, 30.0), 0.0);
}

TEST(ShearRatio, AgreesWithBisection) {
  for (const double tau : {1e-9, 1e-5, 1e-3, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999}) {
    const double expected =
        Bisect(0.0, 2000.0, [tau](double u) { return 1.0 + std::expm1(-u) / u - tau; });
    // Differences of numbers near one leave the reference some 1e-16 / tau.
    EXPECT_NEAR(ShearRatio(tau) / expected, 1.0, 1e-11 + 1e-15 / tau) << tau;
  }
  EXPECT_EQ(ShearRatio(0.0), 0.0);
}

// The table against the laws it interpolates, from a hundredth of its range on.
TEST(WheelSoilTable, IsWithinAPerCentOfTheLaws) {
  constexpr double kMax_N = 300.0;
  for (const terrain::SoilParams& params : Presets()) {
    const WheelSoil soil(params, kRadius_m, kWidth_m);
    const WheelSoilTable table(soil, kMax_N);
    for (double load_N = 0.01 * kMax_N; load_N < kMax_N; load_N *= 1.013) {
      const SoilAnswer answer = table.At(load_N);
      const Rut rut = soil.RutUnder(load_N);
      EXPECT_NEAR(answer.sinkage_m, rut.sinkage_m, 0.01 * rut.sinkage_m) << load_N;
      EXPECT_NEAR(answer.stiffness_N_m, rut.stiffness_N_m, 0.01 * rut.stiffness_N_m) << load_N;
      EXPECT_NEAR(answer.traction_N, rut.largest_traction_N, 0.01 * rut.largest_traction_N);
      EXPECT_NEAR(answer.resistance_N, rut.resistance_N, 0.01 * rut.resistance_N) << load_N;
    }
  }
}

TEST(WheelSoilTable, RefusesALoadThatIsNoNumber) {
  const WheelSoilTable table(WheelSoil(Presets()[0], kRadius_m, kWidth_m), 300.0);
  EXPECT_THROW(table.At(std::numeric_limits<double>::quiet_NaN()), std::runtime_error);
  EXPECT_EQ(table.At(0.0).traction_N, 0.0);
}

}  // namespace
}  // namespace rockyard::rover
