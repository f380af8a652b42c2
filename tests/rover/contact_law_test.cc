// Friction of one contact against the conditions that define it; what slip does to a wheel within
// one step, for one wheel with the mass that it carries.
#include "rover/multibody/contact_law.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <stdexcept>

#include "rover/wheel_soil.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

struct VelocityPerImpulse {
  double a0, a1, a01;
};
constexpr VelocityPerImpulse kContacts[] = {
    {1.0, 1.0, 0.0}, {3.0, 0.5, 0.0}, {2.0, 1.0, 0.9}, {0.2, 40.0, -2.5}};

TEST(FrictionBlock, StopsTheContactWhereTheBoundAllows) {
  for (const VelocityPerImpulse& c : kContacts) {
    FrictionBlock block;
    block.Set(c.a0, c.a1, c.a01);
    const auto [p0, p1] = block.Solve({0.3, -0.4}, 0.0, 100.0);
    EXPECT_NEAR(c.a0 * p0 + c.a01 * p1, 0.3, 1e-12);
    EXPECT_NEAR(c.a01 * p0 + c.a1 * p1, -0.4, 1e-12);
  }
}

// On the bound the velocity that remains, A p - b, is opposite to p: cross product zero, scalar
// product negative. From calls before, another bound or direction, nothing is left.
TEST(FrictionBlock, OpposesSlidingOnTheBound) {
  for (const VelocityPerImpulse& c : kContacts) {
    FrictionBlock block;
    block.Set(c.a0, c.a1, c.a01);
    for (const double most : {1e-6, 0.01, 0.05, 0.002}) {
      for (int i = 0; i < 24; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 24.0;
        const double b0 = 5.0 * std::cos(angle);
        const double b1 = 5.0 * std::sin(angle);
        const auto [p0, p1] = block.Solve({b0, b1}, 0.0, most);
        EXPECT_NEAR(std::hypot(p0, p1) / most, 1.0, 1e-8);
        const double v0 = c.a0 * p0 + c.a01 * p1 - b0;
        const double v1 = c.a01 * p0 + c.a1 * p1 - b1;
        const double size = std::hypot(v0, v1) * most;
        EXPECT_NEAR((v0 * p1 - v1 * p0) / size, 0.0, 1e-8);
        EXPECT_LT((v0 * p0 + v1 * p1) / size, -0.999);
      }
    }
  }
}

// Within the bound a soft contact yields in proportion to its impulse, A p - b = -c p, also after
// calls with another softness; on the bound c changes nothing.
TEST(FrictionBlock, YieldsWithinTheBoundAsSoftAsAsked) {
  for (const VelocityPerImpulse& c : kContacts) {
    FrictionBlock block;
    block.Set(c.a0, c.a1, c.a01);
    for (const double softness : {0.0, 0.3, 5.0, 0.3}) {
      const auto [p0, p1] = block.Solve({0.3, -0.4}, softness, 100.0);
      EXPECT_NEAR(c.a0 * p0 + c.a01 * p1 - 0.3, -softness * p0, 1e-12);
      EXPECT_NEAR(c.a01 * p0 + c.a1 * p1 + 0.4, -softness * p1, 1e-12);
      FrictionBlock rigid;
      rigid.Set(c.a0, c.a1, c.a01);
      const auto bounded = block.Solve({30.0, -40.0}, softness, 1e-3);
      const auto expected = rigid.Solve({30.0, -40.0}, 0.0, 1e-3);
      EXPECT_NEAR(bounded[0], expected[0], 1e-10);
      EXPECT_NEAR(bounded[1], expected[1], 1e-10);
      block.Set(c.a0, c.a1, c.a01);
    }
  }
}

TEST(FrictionBlock, NoBoundNoFriction) {
  FrictionBlock block;
  const auto [p0, p1] = block.Solve({1.0, 2.0}, 0.0, 0.0);
  EXPECT_EQ(p0, 0.0);
  EXPECT_EQ(p1, 0.0);
}

constexpr double kEarth_m_s2 = 9.81;
constexpr double kMars_m_s2 = 3.72;
constexpr double kLoad_N = 33.0;
constexpr double kRim_m_s = 0.15;

ContactLaws LawsOf(const terrain::SoilParams& soil, double gravity_m_s2 = kEarth_m_s2) {
  RoverParams params{.physics = {.gravity_m_s2 = gravity_m_s2}};
  return ContactLaws(params, soil);
}

// A wheel that has borne the load in the last step.
ContactLaw UnderLoad(const ContactLaws& laws, double step_s) {
  Part part{};
  part.kind = truth::BodyPart::kWheel;
  Contact contact;
  contact.impulse_Ns[0] = kLoad_N * step_s;
  return laws.Of(part, contact, step_s);
}

WheelSlip SlipOf(double rim_m_s, double v_m_s) { return {rim_m_s, {v_m_s, 0.0}}; }

// The step with the theta that belongs to it.
SlipStep StepOf(const ContactLaws& laws, const SlipChange& change, double duration_s) {
  const ContactLaw law = UnderLoad(laws, duration_s);
  SlipStep step;
  for (int i = 0; i < 30; ++i) step = laws.StepOfSlip(law, change, step.theta);
  return step;
}

// The share of a small slip that is left after one step of a mass that only this friction acts on:
//   theta v_1 + (1 - theta) v_0 = -c p,   p = m (v_1 - v_0).
double Remains(const SlipStep& step, double mass_kg) {
  const double inertia = mass_kg * step.softness_m_per_Ns;
  return (inertia - (1.0 - step.theta)) / (inertia + step.theta);
}

// While slip is small traction is proportional to it, T = (l / 2 K) T_max |v| / |omega r|, so that
// slip decays as e^(-t / T): the more mass there is under a load, the slower, so on Mars.
TEST(SlipStep, SmallSlipDecaysAsTheSoilSays) {
  const SoilReference soil;
  const double traction_per_slip_N = soil.LargestTraction(kLoad_N) * soil.ContactLength(kLoad_N) /
                                     (2.0 * soil.soil.shear_modulus_m);
  for (const double gravity_m_s2 : {kEarth_m_s2, kMars_m_s2}) {
    const double mass_kg = kLoad_N / gravity_m_s2;
    const double decay_s = mass_kg * kRim_m_s / traction_per_slip_N;
    const ContactLaws laws = LawsOf(soil.soil, gravity_m_s2);
    for (const double z : {0.01, 0.1, 0.3, 0.6, 1.0}) {
      const WheelSlip slip = SlipOf(kRim_m_s, 1e-6);
      const SlipStep step = StepOf(laws, {slip, slip}, z * decay_s);
      EXPECT_NEAR(Remains(step, mass_kg), std::exp(-z), 0.01 * z * z * z + 1e-4 * z)
          << z << ", gravity " << gravity_m_s2;
    }
  }
}

// However much faster than the step traction answers, slip neither grows nor swings: nothing is
// left of it in the end.
TEST(SlipStep, StiffSlipDiesWithoutRinging) {
  const SoilReference soil;
  const ContactLaws laws = LawsOf(soil.soil);
  const double mass_kg = kLoad_N / kEarth_m_s2;
  for (const double rim_m_s : {0.1, 0.03, 0.01, 1e-3, 1e-5}) {
    const WheelSlip slip = SlipOf(rim_m_s, 1e-3 * rim_m_s);
    const SlipStep step = StepOf(laws, {slip, slip}, 1.0 / 15.0);
    EXPECT_LT(std::abs(Remains(step, mass_kg)), 0.1) << rim_m_s;
  }
}

// A step that is short against the decay takes forces halfway, one that is long at its end.
TEST(SlipStep, TakesForcesHalfwayInShortStepsAndLastInLongOnes) {
  const ContactLaws laws = LawsOf(BekkerSoil());
  const WheelSlip fast = SlipOf(kRim_m_s, 0.02);
  EXPECT_NEAR(StepOf(laws, {fast, fast}, 1e-6).theta, 0.5, 1e-3);
  const WheelSlip slow = SlipOf(1e-6, 1e-7);
  EXPECT_NEAR(StepOf(laws, {slow, slow}, 1.0 / 60.0).theta, 1.0, 1e-3);
}

// A steady slip comes with the traction of the curve, whatever the step; beyond a slip of 1 force
// over speed is that of slip 1.
TEST(SlipStep, SteadySlipHasTheTractionOfTheCurve) {
  const SoilReference soil;
  const ContactLaws laws = LawsOf(soil.soil);
  for (const double duration_s : {1.0 / 60.0, 1.0 / 960.0}) {
    for (const double slip : {0.01, 0.1, 0.5, 1.0, 2.0}) {
      const WheelSlip steady = SlipOf(kRim_m_s, -slip * kRim_m_s);
      const SlipStep step = StepOf(laws, {steady, steady}, duration_s);
      const double force_N = slip * kRim_m_s / (step.softness_m_per_Ns * duration_s);
      const double expected_N = soil.LargestTraction(kLoad_N) *
                                soil.Share(std::min(slip, 1.0), kLoad_N) * std::max(slip, 1.0);
      EXPECT_NEAR(force_N, expected_N, 1e-3 * expected_N) << slip << ", " << duration_s << " s";
    }
  }
}

// A wheel that comes to speed has the traction of its mean slip and rim speed, in a step so short
// that its middle counts.
TEST(SlipStep, AChangingSlipCountsHalfway) {
  const ContactLaws laws = LawsOf(BekkerSoil());
  constexpr double kDuration_s = 1e-7;
  const SlipChange change{SlipOf(0.05, 0.04), SlipOf(0.15, 0.02)};
  const WheelSlip mean = SlipOf(0.1, 0.03);
  const double softness = StepOf(laws, change, kDuration_s).softness_m_per_Ns;
  EXPECT_NEAR(softness, StepOf(laws, {mean, mean}, kDuration_s).softness_m_per_Ns, 1e-3 * softness);
}

// Soil that shears without deformation (K = 0), a wheel that stands, and soil without strength have
// no slip that friction could answer to: it holds within its bound, as Coulomb's does.
TEST(SlipStep, HoldsWhereSlipMeansNothing) {
  terrain::SoilParams rigid{.law = terrain::WheelLaw::kBekker, .shear_modulus_m = 0.0};
  terrain::SoilParams weak{
      .law = terrain::WheelLaw::kBekker, .cohesion_Pa = 0.0, .friction_angle_rad = 0.0};
  struct Case {
    const char* name;
    terrain::SoilParams soil = BekkerSoil();
    WheelSlip slip;
  };
  for (const Case& c : {Case{"K = 0", rigid, SlipOf(kRim_m_s, 0.03)},
                        {"K = 0, no slip", rigid, SlipOf(0.1, 0.0)},
                        {"stands", {}, SlipOf(0.0, 0.0)},
                        {"stands and slides", {}, SlipOf(0.0, 0.02)},
                        {"no strength", weak, SlipOf(kRim_m_s, 0.03)}}) {
    const SlipStep step = StepOf(LawsOf(c.soil), {c.slip, c.slip}, 1.0 / 60.0);
    EXPECT_EQ(step.softness_m_per_Ns, 0.0) << c.name;
    EXPECT_EQ(step.theta, 1.0) << c.name;
  }
}

// The wheel-soil model against hand values and its plain reference.

constexpr double kRadius_m = 0.065;
constexpr double kWidth_m = 0.08;

WheelOnSoil OnSoil(const terrain::SoilParams& soil, double max_N) {
  return {soil, {.radius_m = kRadius_m, .width_m = kWidth_m}, 9.81, max_N};
}

class PresetSoil : public testing::TestWithParam<terrain::SoilPreset> {
 protected:
  const terrain::SoilParams params_ = BekkerSoil(GetParam());
  const BekkerWheel soil_{params_, kRadius_m, kWidth_m};
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
TEST(BekkerWheel, HandValuesOfDrySand) {
  const terrain::SoilParams dry_sand{.law = terrain::WheelLaw::kBekker,
                                     .sinkage_exponent = 1.1,
                                     .cohesive_modulus_N_per_mn1 = 0.99e3,
                                     .frictional_modulus_N_per_mn2 = 1528.43e3,
                                     .cohesion_Pa = 1040.0,
                                     .friction_angle_rad = math::DegToRad(28.0),
                                     .shear_modulus_m = 0.010};
  const BekkerWheel soil(dry_sand, kRadius_m, kWidth_m);
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
    for (double slip = 1e-6; slip < 1.0; slip *= 1.7) {
      const double tau = soil_.TractionShare(slip, load_N);
      EXPECT_NEAR(SlipPerShare(slip, soil_.ShearRatio(load_N), shares) * tau / slip, 1.0, 2e-6);
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
  EXPECT_NEAR(SlipPerShare(0.0, soil_.ShearRatio(30.0), ShareTable()),
              2.0 * params_.shear_modulus_m / rut.contact_length_m, 1e-12);
}

TEST(BekkerWheel, PresetsDifferAsTheirNamesSay) {
  const auto sinkage_m = [](terrain::SoilPreset preset) {
    return BekkerWheel(BekkerSoil(preset), kRadius_m, kWidth_m).Sinkage_m(30.0);
  };
  EXPECT_LT(sinkage_m(terrain::SoilPreset::kHardGround), 2e-5);
  EXPECT_GT(sinkage_m(terrain::SoilPreset::kLandscapingSand), 5e-4);
  EXPECT_GT(sinkage_m(terrain::SoilPreset::kMarsDrift),
            3.0 * sinkage_m(terrain::SoilPreset::kLandscapingSand));
  const BekkerWheel hard(BekkerSoil(terrain::SoilPreset::kHardGround), kRadius_m, kWidth_m);
  EXPECT_NEAR(hard.LargestTraction_N(30.0), 0.8 * 30.0, 0.01);
  EXPECT_EQ(hard.TractionShare(1e-9, 30.0), 1.0);
}

// The table against the laws it interpolates, from a hundredth of its range on.
TEST_P(PresetSoilTable, IsWithinAPerCentOfTheLaws) {
  constexpr double kMax_N = 300.0;
  const WheelSoilTable table(OnSoil(params_, kMax_N), kMax_N);
  for (double load_N = 0.01 * kMax_N; load_N < kMax_N; load_N *= 1.013) {
    const SoilAnswer answer = table.At(load_N, 0.0);
    const Rut rut = soil_.RutUnder(load_N);
    EXPECT_NEAR(answer.sinkage_m, rut.sinkage_m, 0.01 * rut.sinkage_m) << load_N;
    EXPECT_NEAR(answer.stiffness_N_m, rut.stiffness_N_m, 0.01 * rut.stiffness_N_m) << load_N;
    EXPECT_NEAR(answer.traction_N, rut.largest_traction_N, 0.01 * rut.largest_traction_N);
    EXPECT_NEAR(answer.resistance_N, rut.resistance_N, 0.01 * rut.resistance_N) << load_N;
  }
}

TEST(WheelSoilTable, RefusesALoadThatIsNoNumber) {
  const WheelSoilTable table(OnSoil(BekkerSoil(), 300.0), 300.0);
  EXPECT_THROW(table.At(std::numeric_limits<double>::quiet_NaN(), 0.0), std::runtime_error);
  EXPECT_EQ(table.At(0.0, 0.0).traction_N, 0.0);
}

}  // namespace
}  // namespace rockyard::rover
