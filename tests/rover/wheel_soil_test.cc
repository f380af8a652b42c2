// The wheel-soil model against hand values and its plain reference.
#include "rover/wheel_soil.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>

#include "soil_reference.h"

namespace rockyard::rover {
namespace {

constexpr double kRadius_m = 0.065;
constexpr double kWidth_m = 0.08;

class PresetSoil : public testing::TestWithParam<terrain::SoilPreset> {
 protected:
  const terrain::SoilParams params_ = terrain::MakeSoil(GetParam());
  const WheelSoil soil_{params_, kRadius_m, kWidth_m};
};

constexpr terrain::SoilPreset kPresets[] = {terrain::SoilPreset::kLandscapingSand,
                                            terrain::SoilPreset::kMarsDrift,
                                            terrain::SoilPreset::kHardGround};
using PresetSoilTable = PresetSoil;
INSTANTIATE_TEST_SUITE_P(Presets, PresetSoil, testing::ValuesIn(kPresets));
INSTANTIATE_TEST_SUITE_P(Presets, PresetSoilTable, testing::ValuesIn(kPresets));

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

TEST_P(PresetSoil, AgreesWithItsPlainReference) {
  const SoilReference reference{params_, kRadius_m, kWidth_m};
  for (const double load_N : {0.5, 5.0, 30.0, 120.0}) {
    const Rut rut = soil_.RutUnder(load_N);
    EXPECT_NEAR(rut.sinkage_m, reference.Sinkage(load_N), 1e-9 * kRadius_m);
    EXPECT_NEAR(rut.resistance_N / reference.Resistance(load_N), 1.0, 1e-5);
    EXPECT_NEAR(rut.contact_length_m / reference.ContactLength(load_N), 1.0, 1e-5);
    EXPECT_NEAR(rut.largest_traction_N / reference.LargestTraction(load_N), 1.0, 1e-6);
    for (const double slip : {0.01, 0.2, 1.0}) {
      EXPECT_NEAR(soil_.TractionShare(slip, load_N), reference.Share(slip, load_N), 1e-6);
    }
  }
}

TEST_P(PresetSoil, StiffnessIsTheDerivativeOfTheLoad) {
  const SoilReference reference{params_, kRadius_m, kWidth_m};
  for (const double load_N : {0.5, 30.0, 120.0}) {
    const Rut rut = soil_.RutUnder(load_N);
    EXPECT_NEAR(reference.Load(rut.sinkage_m) / load_N, 1.0, 1e-12);
    const double dz_m = 1e-4 * rut.sinkage_m;
    const double rise_N =
        reference.Load(rut.sinkage_m + dz_m) - reference.Load(rut.sinkage_m - dz_m);
    EXPECT_NEAR(rut.stiffness_N_m * 2.0 * dz_m / rise_N, 1.0, 1e-6);
  }
}

// By a table, within 1e-7 of tau.
TEST_P(PresetSoil, SlipPerShareIsThatOfTheLaw) {
  const ShareTable shares;
  if (params_.shear_modulus_m == 0.0) return;
  for (const double load_N : {1.0, 30.0}) {
    const Rut rut = soil_.RutUnder(load_N);
    for (double slip = 1e-6; slip < 1.0; slip *= 1.7) {
      const double tau = soil_.TractionShare(slip, load_N);
      EXPECT_NEAR(soil_.SlipPerShare(slip, rut, shares) * tau / slip, 1.0, 2e-6);
    }
  }
}

TEST_P(PresetSoil, EverythingGrowsWithLoadAndSlip) {
  for (double load_N = 0.1; load_N < 200.0; load_N *= 1.3) {
    const Rut rut = soil_.RutUnder(load_N);
    const Rut more = soil_.RutUnder(1.3 * load_N);
    EXPECT_GT(more.sinkage_m, rut.sinkage_m);
    EXPECT_GT(more.resistance_N, rut.resistance_N);
    EXPECT_GT(more.contact_length_m, rut.contact_length_m);
    EXPECT_GT(more.largest_traction_N, rut.largest_traction_N);
  }
  double last = 0.0;
  for (double slip = 0.01; slip < 1.0; slip += 0.01) {
    EXPECT_GE(soil_.TractionShare(slip, 30.0), last);
    last = soil_.TractionShare(slip, 30.0);
  }
}

TEST_P(PresetSoil, Limits) {
  EXPECT_EQ(soil_.Sinkage_m(0.0), 0.0);
  EXPECT_EQ(soil_.Resistance_N(0.0), 0.0);
  EXPECT_EQ(soil_.ContactLength_m(0.0), 0.0);
  EXPECT_EQ(soil_.LargestTraction_N(0.0), 0.0);
  EXPECT_EQ(soil_.TractionShare(0.0, 30.0), 0.0);
  // A wheel deeper than itself has no rim above the soil.
  EXPECT_LE(soil_.ContactLength_m(1e9), std::numbers::pi * kRadius_m + 1e-12);
  // Small slip: tau = u / 2.
  const Rut rut = soil_.RutUnder(30.0);
  EXPECT_NEAR(soil_.SlipPerShare(0.0, rut, ShareTable()),
              2.0 * params_.shear_modulus_m / rut.contact_length_m, 1e-12);
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
  EXPECT_EQ(hard.TractionShare(1e-9, 30.0), 1.0);
}

// The table against the laws it interpolates, from a hundredth of its range on.
TEST_P(PresetSoilTable, IsWithinAPerCentOfTheLaws) {
  constexpr double kMax_N = 300.0;
  const WheelSoilTable table(soil_, kMax_N);
  for (double load_N = 0.01 * kMax_N; load_N < kMax_N; load_N *= 1.013) {
    const SoilAnswer answer = table.At(load_N);
    const Rut rut = soil_.RutUnder(load_N);
    EXPECT_NEAR(answer.sinkage_m, rut.sinkage_m, 0.01 * rut.sinkage_m) << load_N;
    EXPECT_NEAR(answer.stiffness_N_m, rut.stiffness_N_m, 0.01 * rut.stiffness_N_m) << load_N;
    EXPECT_NEAR(answer.traction_N, rut.largest_traction_N, 0.01 * rut.largest_traction_N);
    EXPECT_NEAR(answer.resistance_N, rut.resistance_N, 0.01 * rut.resistance_N) << load_N;
  }
}

TEST(WheelSoilTable, RefusesALoadThatIsNoNumber) {
  const WheelSoilTable table(WheelSoil({}, kRadius_m, kWidth_m), 300.0);
  EXPECT_THROW(table.At(std::numeric_limits<double>::quiet_NaN()), std::runtime_error);
  EXPECT_EQ(table.At(0.0).traction_N, 0.0);
}

}  // namespace
}  // namespace rockyard::rover
