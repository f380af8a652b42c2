// The wheel on soil as rovers and rigs have it: the table of a law of stresses, granular scaling,
// and the wheel that a carriage leads.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "law_cases.h"
#include "rover/steady_wheel.h"
#include "rover/wheel_law_params.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

using terrain::SoilPressure;
using terrain::WheelLaw;

// What a law says of a load, by bisection.
RimForces Under(const RimStress& stress, double load_N, double slip, double& sinkage_m) {
  const double entry_rad =
      Bisect(1e-4, 1.5, [&](double angle) { return stress.At(angle, slip).load_N - load_N; });
  sinkage_m = kSmooth.radius_m * (1.0 - std::cos(entry_rad));
  return stress.At(entry_rad, slip);
}

TEST(RimStressTableLaw, IsWithinAPercentOfItsLaw) {
  constexpr double kLargest_N = 300.0;
  for (const LawCase& kind : kStressLaws) {
    const RimStress stress(SoilOf(kind), kSmooth, kLabGravity_m_s2);
    const WheelOnSoil table(SoilOf(kind), kSmooth, kLabGravity_m_s2, kLargest_N);
    for (const double load_N : {0.3, 1.0, 7.0, 40.0, 133.0, 300.0}) {
      for (const double slip : {0.0, 0.1, 0.17, 0.33, 0.5, 0.71, 0.9}) {
        double sinkage_m = 0.0;
        const RimForces law = Under(stress, load_N, slip, sinkage_m);
        const SteadyForces told = SteadyWheel(table, kSmooth.radius_m, load_N, slip);
        const auto where = testing::Message() << "law " << static_cast<int>(kind.law) << " of "
                                              << load_N << " N at " << slip;
        EXPECT_NEAR(told.sinkage_m, sinkage_m, 0.01 * sinkage_m) << where;
        EXPECT_NEAR(told.pull_N, law.pull_N, 0.01 * load_N) << where;
        const SoilAnswer answer = table.Under(load_N, slip);
        EXPECT_NEAR(answer.side_N, law.side_N, 0.01 * law.side_N + 1e-3 * load_N) << where;
        const double more_N = 0.01 * load_N;
        double deeper_m = 0.0;
        Under(stress, load_N + more_N, slip, deeper_m);
        EXPECT_NEAR(answer.stiffness_N_m, more_N / (deeper_m - sinkage_m),
                    0.1 * answer.stiffness_N_m)
            << where;
      }
    }
  }
}

// Slonaker et al. 2017: wheels go alike where M g / (rho g L^3) is the same.
class GranularScaling : public testing::Test {
 protected:
  // Largest difference of pull over load and of sinkage over radius from the wheel of size 1 on
  // Earth.
  static double Apart(const terrain::SoilParams& soil) {
    double apart = 0.0;
    for (const double size : {0.5, 2.0}) {
      for (const double gravity_m_s2 : {1.62, 3.71, kLabGravity_m_s2}) {
        for (const double slip : {0.05, 0.3, 0.8}) {
          const SteadyForces base = Of(soil, 1.0, kLabGravity_m_s2, slip);
          const SteadyForces other = Of(soil, size, gravity_m_s2, slip);
          apart = std::max({apart, std::abs(other.pull_N - base.pull_N),
                            std::abs(other.sinkage_m / base.sinkage_m - 1.0)});
        }
      }
    }
    return apart;
  }

 private:
  // Forces over the load, sinkage over the radius.
  static SteadyForces Of(const terrain::SoilParams& soil, double size, double gravity_m_s2,
                         double slip) {
    const RimShape wheel{.radius_m = 0.15 * size,
                         .width_m = 0.12 * size,
                         .lug_height_m = 0.008 * size,
                         .lug_count = 12};
    const double load_N = 12.0 * gravity_m_s2 * std::pow(size, 3);
    SteadyForces forces =
        SteadyWheel({soil, wheel, gravity_m_s2, 4.0 * load_N}, wheel.radius_m, load_N, slip);
    forces.pull_N /= load_N;
    forces.sinkage_m /= wheel.radius_m;
    return forces;
  }
};

TEST_F(GranularScaling, HoldsWhereThePressureIsThatOfADensity) {
  EXPECT_LT(Apart(SoilOf({WheelLaw::kResistiveForce, SoilPressure::kDensity})), 1e-6);
  EXPECT_LT(Apart(SoilOf({WheelLaw::kIntrusion, SoilPressure::kDensity})), 1e-6);
}

TEST_F(GranularScaling, DoesNotHoldForPlatesOrBekker) {
  EXPECT_GT(Apart(SoilOf({WheelLaw::kBekker, SoilPressure::kPlate})), 0.1);
  EXPECT_GT(Apart(SoilOf({WheelLaw::kIntrusion, SoilPressure::kPlate})), 0.1);
  // Cohesion has a pressure of its own.
  terrain::SoilParams cohesive = SoilOf({WheelLaw::kIntrusion, SoilPressure::kDensity});
  cohesive.cohesion_Pa = 1000.0;
  EXPECT_GT(Apart(cohesive), 0.01);
}

// Bekker's wheel, whose closed forms are those of soil_reference.h.
class CarriageLaw : public testing::Test {
 protected:
  terrain::SoilParams soil_ = SoilOf({WheelLaw::kBekker, SoilPressure::kPlate});
  WheelOnSoil wheel_{soil_, kSmooth, kLabGravity_m_s2, 200.0};
  SoilReference reference_{soil_, kSmooth.radius_m, kSmooth.width_m};
  SteadyForces At(double load_N, double slip, double angle_rad = 0.0) const {
    return SteadyWheel(wheel_, kSmooth.radius_m, load_N, slip, angle_rad);
  }
};

TEST_F(CarriageLaw, DrivenAndSkidding) {
  for (const double load_N : {20.0, 80.0}) {
    const double most_N = reference_.LargestTraction(load_N);
    const double resists_N = reference_.Resistance(load_N);
    const SteadyForces towed = At(load_N, 0.0);
    EXPECT_NEAR(towed.pull_N, -resists_N, 1e-4 * resists_N);
    EXPECT_EQ(towed.torque_Nm, 0.0);
    EXPECT_EQ(towed.side_N, 0.0);
    const SteadyForces driven = At(load_N, 0.3);
    const double drives_N = reference_.Share(0.3, load_N) * most_N;
    EXPECT_NEAR(driven.pull_N, drives_N - resists_N, 1e-4 * load_N);
    EXPECT_NEAR(driven.torque_Nm, kSmooth.radius_m * drives_N, 1e-4 * load_N);
    EXPECT_NEAR(driven.sinkage_m, reference_.Sinkage(load_N), 1e-8);
    // A rim half as fast as the carriage: the contact slides ahead at the speed of the rim.
    const SteadyForces skidding = At(load_N, -0.5);
    const double brakes_N = reference_.Share(1.0, load_N) * most_N;
    EXPECT_NEAR(skidding.pull_N, -brakes_N - resists_N, 1e-4 * load_N);
    EXPECT_NEAR(skidding.torque_Nm, -kSmooth.radius_m * brakes_N, 1e-4 * load_N);
  }
}

TEST_F(CarriageLaw, AcrossTheWheel) {
  // Travel across the wheel at the rim's speed, or at 0.6 of it: along, the whole rim slides.
  const double load_N = 60.0;
  for (const double slip : {0.0, 0.4}) {
    const double slides = std::hypot(1.0, 1.0 - slip);
    const double traction_N = reference_.Share(slides, load_N) * reference_.LargestTraction(load_N);
    const SteadyForces forces = At(load_N, slip, 0.5 * std::numbers::pi);
    EXPECT_NEAR(forces.side_N, traction_N * (1.0 - slip) / slides, 1e-4 * load_N);
    EXPECT_NEAR(forces.torque_Nm, kSmooth.radius_m * traction_N / slides, 1e-4 * load_N);
    const SteadyForces mirrored = At(load_N, slip, -0.5 * std::numbers::pi);
    EXPECT_EQ(mirrored.side_N, -forces.side_N);
    EXPECT_EQ(mirrored.pull_N, forces.pull_N);
  }
  // A law of stresses presses on the side face besides.
  const terrain::SoilParams soil = SoilOf({WheelLaw::kIntrusion, SoilPressure::kDensity});
  const WheelOnSoil stressed(soil, kSmooth, kLabGravity_m_s2, 200.0);
  const SoilAnswer answer = stressed.Under(load_N, 1.0);
  const SteadyForces dragged =
      SteadyWheel(stressed, kSmooth.radius_m, load_N, 0.0, 0.5 * std::numbers::pi);
  EXPECT_GT(answer.side_N, 1.0);
  EXPECT_NEAR(dragged.side_N - answer.side_N, dragged.torque_Nm / kSmooth.radius_m, 1e-9);
  EXPECT_EQ(SteadyWheel(stressed, kSmooth.radius_m, load_N, 0.0, -0.5 * std::numbers::pi).side_N,
            -dragged.side_N);
  EXPECT_EQ(SteadyWheel(stressed, kSmooth.radius_m, load_N, 0.3).side_N, 0.0);
}

TEST_F(CarriageLaw, RefusesWhatHasNoSteadyState) {
  const double nan = std::nan("");
  EXPECT_THROW(At(0.0, 0.1), core::UserError);
  EXPECT_THROW(At(-5.0, 0.1), core::UserError);
  EXPECT_THROW(At(nan, 0.1), core::UserError);
  EXPECT_THROW(At(10.0, 1.0), core::UserError);
  EXPECT_THROW(At(10.0, -1.0), core::UserError);
  EXPECT_THROW(At(10.0, nan), core::UserError);
  EXPECT_THROW(At(10.0, 0.1, 1.6), core::UserError);
  EXPECT_NO_THROW(At(10.0, -0.999, 1.5));
}

}  // namespace
}  // namespace rockyard::rover
