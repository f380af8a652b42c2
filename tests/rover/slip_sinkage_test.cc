// Wheels that slip dig in: the law by plain references, and rovers of both fidelities on slopes.

#include <gtest/gtest.h>

#include "rover/wheel_soil.h"
#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

constexpr double kRadius_m = 0.065;
constexpr double kWidth_m = 0.08;
constexpr double kLength_m = 0.1;
constexpr double kPerSlip = 0.5;

terrain::SoilParams Digging(terrain::SoilPreset preset = terrain::SoilPreset::kLandscapingSand,
                            double per_slip = kPerSlip) {
  terrain::SoilParams soil = BekkerSoil(preset);
  soil.slip_sinkage = {.enabled = true, .exponent_per_slip = per_slip, .length_m = kLength_m};
  return soil;
}

WheelOnSoil OnSoil(const terrain::SoilParams& soil, double max_N) {
  return {soil, {.radius_m = kRadius_m, .width_m = kWidth_m}, 9.81, max_N};
}

SlipSinkage Sinkage(const terrain::SoilParams& soil) {
  return {soil, OnSoil(soil, 200.0), kRadius_m, 33.0};
}

// The plain soil whose exponent is that of the slip.
SoilReference Dug(terrain::SoilParams soil, double slip) {
  soil.sinkage_exponent += soil.slip_sinkage.exponent_per_slip * slip;
  return {soil};
}

TEST(SlipSinkageLaw, IsBekkersWithTheExponentOfTheSlip) {
  for (const auto preset :
       {terrain::SoilPreset::kLandscapingSand, terrain::SoilPreset::kMarsDrift}) {
    const terrain::SoilParams soil = Digging(preset);
    const BekkerWheel wheel(soil, kRadius_m, kWidth_m);
    for (const double slip : {0.1, 0.35, 0.6, 1.0}) {
      for (const double load_N : {3.0, 12.0, 40.0}) {
        const SoilReference dug = Dug(soil, slip);
        const Rut rut = wheel.RutUnder(load_N, slip);
        EXPECT_NEAR(rut.sinkage_m, dug.Sinkage(load_N), 1e-9) << slip;
        EXPECT_NEAR(rut.resistance_N, dug.Resistance(load_N), 1e-4 * rut.resistance_N) << slip;
        const double more_N = 1e-4 * load_N;
        const double deeper_m = dug.Sinkage(load_N + more_N) - dug.Sinkage(load_N - more_N);
        EXPECT_NEAR(rut.stiffness_N_m, 2.0 * more_N / deeper_m, 1e-5 * rut.stiffness_N_m);
        // What the wheel pulls with is as before.
        const SoilReference before{soil};
        EXPECT_NEAR(rut.contact_length_m, before.ContactLength(load_N), 1e-9);
        EXPECT_NEAR(rut.largest_traction_N, before.LargestTraction(load_N), 1e-6);
        EXPECT_EQ(rut.load_N, load_N);
      }
    }
  }
}

// Ding et al. 2010 (abstract): at a slip of 0.6 wheels sink 3 to 7 times as deep as without slip.
TEST(SlipSinkageLaw, TheRangeOfStudiesIsThatOfTheExperiment) {
  const double load_N = 33.0;
  const auto ratio = [&](double per_slip) {
    const BekkerWheel wheel(Digging(terrain::SoilPreset::kLandscapingSand, per_slip), kRadius_m,
                            kWidth_m);
    return wheel.RutUnder(load_N, 0.6).sinkage_m / wheel.RutUnder(load_N).sinkage_m;
  };
  EXPECT_NEAR(ratio(0.4), 3.0, 0.1);
  EXPECT_NEAR(ratio(0.83), 7.0, 0.1);
}

TEST(SlipSinkageLaw, ChangesNoBitWithoutSlipAndWhereItIsOff) {
  const auto same = [](const Rut& a, const Rut& b) {
    return a.sinkage_m == b.sinkage_m && a.stiffness_N_m == b.stiffness_N_m &&
           a.resistance_N == b.resistance_N && a.contact_length_m == b.contact_length_m &&
           a.largest_traction_N == b.largest_traction_N && a.load_N == b.load_N;
  };
  terrain::SoilParams off = Digging();
  off.slip_sinkage.enabled = false;
  const BekkerWheel plain(BekkerSoil(), kRadius_m, kWidth_m);
  const BekkerWheel digs(Digging(), kRadius_m, kWidth_m);
  const BekkerWheel never(off, kRadius_m, kWidth_m);
  for (const double load_N : {1.0, 33.0, 150.0}) {
    EXPECT_TRUE(same(digs.RutUnder(load_N, 0.0), plain.RutUnder(load_N)));
    EXPECT_TRUE(same(never.RutUnder(load_N, 0.7), plain.RutUnder(load_N)));
    EXPECT_FALSE(same(digs.RutUnder(load_N, 0.7), plain.RutUnder(load_N)));
  }
}

// A wheel deeper than its axle is no wheel of these laws.
TEST(SlipSinkageLaw, EndsAtTheAxle) {
  const BekkerWheel wheel(Digging(terrain::SoilPreset::kMarsDrift, 0.9), kRadius_m, kWidth_m);
  EXPECT_LT(wheel.RutUnder(12.0, 1.0).sinkage_m, kRadius_m);
  EXPECT_EQ(wheel.RutUnder(120.0, 1.0).sinkage_m, kRadius_m);
}

TEST(SlipSinkageTable, IsWithinAPerCentOfTheLaw) {
  constexpr double kMax_N = 200.0;
  for (const auto preset :
       {terrain::SoilPreset::kLandscapingSand, terrain::SoilPreset::kMarsDrift}) {
    const BekkerWheel soil(Digging(preset), kRadius_m, kWidth_m);
    const WheelSoilTable table(OnSoil(Digging(preset), kMax_N), kMax_N);
    const WheelSoilTable plain(OnSoil(BekkerSoil(preset), kMax_N), kMax_N);
    for (double load_N = 2.0; load_N < 60.0; load_N *= 1.17) {
      for (double slip = 0.0; slip <= 1.0; slip += 0.04) {
        const Rut rut = soil.RutUnder(load_N, slip);
        const SoilAnswer answer = table.At(load_N, slip);
        EXPECT_NEAR(answer.sinkage_m, rut.sinkage_m, 0.01 * rut.sinkage_m) << slip;
        EXPECT_NEAR(answer.resistance_N, rut.resistance_N, 0.01 * rut.resistance_N) << slip;
        EXPECT_NEAR(answer.stiffness_N_m, rut.stiffness_N_m, 0.01 * rut.stiffness_N_m) << slip;
        EXPECT_NEAR(answer.traction_N, rut.largest_traction_N, 0.01 * rut.largest_traction_N);
        EXPECT_EQ(plain.At(load_N, slip).sinkage_m, plain.At(load_N, 0.0).sinkage_m);
      }
      EXPECT_EQ(table.At(load_N, 1.2).sinkage_m, table.At(load_N, 1.0).sinkage_m);
    }
  }
}

// d = i (1 - e^(-i s / L)), however finely the way is cut.
TEST(SlipSinkageState, DigsInOverTheWayThatTheRimSlides) {
  for (const double slip : {0.2, 0.5, 1.0}) {
    for (const int parts : {1, 7, 200}) {
      SlipSinkage sinkage = Sinkage(Digging());
      constexpr double kWay_m = 0.15;
      for (int i = 0; i < parts; ++i) sinkage.Roll(2, slip, kWay_m / parts);
      EXPECT_NEAR(sinkage.dug_slip(2), slip * (1.0 - std::exp(-slip * kWay_m / kLength_m)), 1e-12);
      EXPECT_EQ(sinkage.dug_slip(1), 0.0);
    }
  }
}

// From d_0: d = i + (d_0 - i) e^(-(1 - i) s / L).
TEST(SlipSinkageState, ComesOutOverTheWayThatItRollsOn) {
  SlipSinkage sinkage = Sinkage(Digging());
  sinkage.Roll(0, 1.0, 100.0 * kLength_m);
  EXPECT_NEAR(sinkage.dug_slip(0), 1.0, 1e-12);
  sinkage.Roll(0, 0.25, 0.08);
  EXPECT_NEAR(sinkage.dug_slip(0), 0.25 + 0.75 * std::exp(-0.75 * 0.08 / kLength_m), 1e-12);
  sinkage.Roll(0, 0.0, 100.0 * kLength_m);
  EXPECT_NEAR(sinkage.dug_slip(0), 0.0, 1e-12);
}

TEST(SlipSinkageState, StandsStillWithTheWheelAndWhereItIsOff) {
  SlipSinkage sinkage = Sinkage(Digging());
  sinkage.Roll(0, 3.0, 0.05);  // slides faster than it turns: as at 1
  EXPECT_NEAR(sinkage.dug_slip(0), 1.0 - std::exp(-0.5), 1e-12);
  const double before = sinkage.dug_slip(0);
  sinkage.Roll(0, 1.0, 0.0);
  EXPECT_EQ(sinkage.dug_slip(0), before);
  sinkage.Clear();
  EXPECT_EQ(sinkage.dug_slip(0), 0.0);
  SlipSinkage off = Sinkage(BekkerSoil());
  off.Roll(0, 1.0, 1.0);
  EXPECT_EQ(off.dug_slip(0), 0.0);
}

// Where sum tau(i) T_max = W sin(slope) + sum R(n_0 + n_1 i).
double ClosedFormSlip(const terrain::SoilParams& soil, double pull_N,
                      const messages::PerWheel<double>& load_N) {
  const SoilReference traction{soil};
  return Bisect(0.0, 1.0, [&](double slip) {
    return traction.Traction(slip, load_N) - Dug(soil, slip).SumResistance(load_N) - pull_N;
  });
}

class SlipSinkageRover : public ::testing::TestWithParam<Fidelity> {};

TEST_P(SlipSinkageRover, ClimbsAtTheSlipOfTheClosedForm) {
  const RoverParams params = WithFidelity(GetParam());
  const terrain::SoilParams soil = Digging();
  for (const double slope_deg : {0.0, 5.0, 10.0}) {
    const SlopeClimb climb = SteadyClimb(params, slope_deg, soil);
    const double pull_N = Weights(params).total_N * std::sin(math::DegToRad(slope_deg));
    const double slip = ClosedFormSlip(soil, pull_N, climb.load_N);
    EXPECT_NEAR(climb.slip, slip, 0.01 + 0.02 * slip) << slope_deg;
    // The motors pull the weight and the resistance of the deeper rut.
    const double needed_N = pull_N + Dug(soil, slip).SumResistance(climb.load_N);
    EXPECT_NEAR(climb.torque_Nm / kRadius_m, needed_N, 0.02 * needed_N) << slope_deg;
    const double load_N = Weights(params).total_N * std::cos(math::DegToRad(slope_deg)) / 6.0;
    const double depth_m = Dug(soil, slip).Sinkage(load_N);
    EXPECT_NEAR(climb.sinkage_m, depth_m, 0.04 * depth_m) << slope_deg;
  }
}

TEST_P(SlipSinkageRover, SlipsMoreTheMoreASlipDigs) {
  const RoverParams params = WithFidelity(GetParam());
  double last = SteadyClimb(params, 10.0, BekkerSoil()).slip;
  for (const double per_slip : {0.3, 0.6}) {
    const double slip =
        SteadyClimb(params, 10.0, Digging(terrain::SoilPreset::kLandscapingSand, per_slip)).slip;
    EXPECT_GT(slip, last + 0.02) << per_slip;
    last = slip;
  }
}

// A slope on which wheels spin with it, and do not without: 18 deg of sand.
TEST_P(SlipSinkageRover, IsEmbeddedWhereItWouldClimb) {
  const RoverParams params = WithFidelity(GetParam());
  EXPECT_LT(SteadyClimb(params, 18.0, BekkerSoil()).slip, 0.8);
  const SlopeClimb climb = SteadyClimb(params, 18.0, Digging());
  EXPECT_GT(climb.slip, 0.95);
  EXPECT_GT(climb.sinkage_m, 0.007);
}

// In drift on 20 deg wheels spin on the spot at once, i = 1: they sink with the way s of the rim,
// by the law at d = 1 - e^(-s / L), but for the damping of the multibody's contacts.
TEST_P(SlipSinkageRover, SpinningWheelsDigInLittleByLittle) {
  RoverParams params = WithFidelity(GetParam());
  params.physics.gravity_m_s2 = 3.72;
  params.quasi_static.settle_distance_m = 0.005;
  const terrain::SoilParams soil = Digging(terrain::SoilPreset::kMarsDrift);
  const RoverOn rover(SlopeTerrain(math::DegToRad(20.0), 0.0, soil), params);
  const double load_N = Weights(params).total_N * std::cos(math::DegToRad(20.0)) / 6.0;
  double last_m = 0.0;
  for (const double way_m : {0.03, 0.06, 0.1, 0.2, 0.4}) {
    while (rover->state().wheel_angle_rad[0] * kRadius_m < way_m) {
      rover->Step(Drive(params, 0.01, 0.0));
    }
    double mean_m = 0.0;
    for (const double sinkage_m : rover->state().wheel_sinkage_m) mean_m += sinkage_m / 6.0;
    const double dug = 1.0 - std::exp(-way_m / kLength_m);
    const double depth_m = Dug(soil, dug).Sinkage(load_N);
    EXPECT_NEAR(mean_m, depth_m, 0.09 * depth_m) << way_m;
    EXPECT_GT(mean_m, last_m);
    last_m = mean_m;
  }
  // Lifted and put down again, wheels have not dug.
  rover->Place({2.0, 1.0, 0.0});
  const double fresh_m = SoilReference{soil}.Sinkage(load_N);
  double mean_m = 0.0;
  for (const double sinkage_m : rover->state().wheel_sinkage_m) mean_m += sinkage_m / 6.0;
  EXPECT_NEAR(mean_m, fresh_m, 0.05 * fresh_m);
}

TEST_P(SlipSinkageRover, ChangesNoBitWhereItIsOff) {
  const RoverParams params = WithFidelity(GetParam());
  terrain::SoilParams off = BekkerSoil();
  off.slip_sinkage = {.enabled = false, .exponent_per_slip = 0.9, .length_m = 0.01};
  const auto drive = [&](const terrain::SoilParams& soil) {
    const RoverOn rover(SlopeTerrain(math::DegToRad(12.0), 0.4, soil), params);
    RunFor(*rover, Drive(params, 0.15, 0.1), 5.0);
    return rover->state().X_WR.matrix();
  };
  EXPECT_EQ(drive(off), drive(BekkerSoil()));
  EXPECT_NE(drive(Digging()), drive(BekkerSoil()));
}

INSTANTIATE_TEST_SUITE_P(BothFidelities, SlipSinkageRover,
                         ::testing::Values(Fidelity::kMultibody, Fidelity::kQuasiStatic),
                         [](const auto& tested) {
                           return tested.param == Fidelity::kMultibody ? "Multibody"
                                                                       : "QuasiStatic";
                         });

}  // namespace
}  // namespace rockyard::rover
