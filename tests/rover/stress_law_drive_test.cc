// Rovers of both fidelities on soil by a law of stresses, against the closed form of its table.

#include <gtest/gtest.h>

#include "rover/rover_params.h"
#include "rover/wheel_soil.h"
#include "rover_drive.h"
#include "soil_reference.h"

namespace rockyard::rover {
namespace {

terrain::SoilParams Granular() {
  terrain::SoilParams soil;
  soil.law = terrain::WheelLaw::kIntrusion;
  soil.pressure = terrain::SoilPressure::kDensity;
  soil.friction_angle_rad = math::DegToRad(35.0);
  soil.cohesion_Pa = 0.0;
  return soil;
}

terrain::SoilParams Intrusion(terrain::SoilPreset preset) {
  terrain::SoilParams soil = terrain::MakeSoil(preset);
  soil.law = terrain::WheelLaw::kIntrusion;
  return soil;
}

// The slip at which six wheels of that load pull with that force, 1 where they cannot.
struct ClosedForm {
  WheelOnSoil wheel;
  messages::PerWheel<double> load_N;

  double Gross(double slip) const {
    double sum_N = 0.0;
    for (const double load : load_N) {
      const SoilAnswer soil = wheel.Under(load, slip);
      sum_N += soil.traction_N * ShareOfRatio(soil.shear_ratio * slip).value;
    }
    return sum_N;
  }
  double Resistance(double slip) const {
    double sum_N = 0.0;
    for (const double load : load_N) sum_N += wheel.Under(load, slip).resistance_N;
    return sum_N;
  }
  double Slip(double pull_N) const {
    return Bisect(0.0, 1.0, [&](double slip) { return Gross(slip) - Resistance(slip) - pull_N; });
  }
};

class StressLaw : public ::testing::TestWithParam<Fidelity> {};

TEST_P(StressLaw, ClimbsAtTheSlipOfTheClosedForm) {
  const RoverParams params = WithFidelity(GetParam());
  for (const terrain::SoilParams& soil : {Intrusion(terrain::SoilPreset::kLandscapingSand),
                                          Intrusion(terrain::SoilPreset::kMarsDrift), Granular()}) {
    for (const double slope_deg : {0.0, 5.0, 10.0, 15.0, 20.0}) {
      const SlopeClimb climb = SteadyClimb(params, slope_deg, soil);
      const ClosedForm form{MakeWheelOnSoil(params, soil), climb.load_N};
      const double pull_N = Weights(params).total_N * std::sin(math::DegToRad(slope_deg));
      const double slip = form.Slip(pull_N);
      EXPECT_NEAR(climb.slip, slip, 0.004 + 0.02 * slip) << slope_deg;
      if (slip > 0.98) continue;
      const double needed_N = pull_N + form.Resistance(slip);
      EXPECT_NEAR(climb.torque_Nm / params.geometry.wheel_radius_m, needed_N, 0.03 * needed_N)
          << slope_deg;
      double depth_m = 0.0;
      for (const double load : climb.load_N) depth_m += form.wheel.Under(load, slip).sinkage_m / 6;
      EXPECT_NEAR(climb.sinkage_m, depth_m, 0.02 * depth_m) << slope_deg;
    }
  }
}

// The soil at the side faces holds a braked rover on a slope across it beside the friction.
TEST_P(StressLaw, SideFacesHoldAcross) {
  const RoverParams params = WithFidelity(GetParam());
  const terrain::SoilParams soil = Granular();
  const double load_N = Weights(params).total_N / 6.0;
  const SoilAnswer answer = MakeWheelOnSoil(params, soil).Under(load_N, 0.0);
  const double friction = std::atan(answer.traction_N / load_N);
  const double both = std::atan((answer.traction_N + answer.side_N) / load_N);
  ASSERT_GT(both - friction, math::DegToRad(1.0));
  const auto moved_m = [&](double slope_rad) {
    const RoverOn rover(SlopeTerrain(slope_rad, 0.5 * std::numbers::pi, soil), params);
    RunFor(*rover, kBraked, 1.0);
    const math::Vector3 from = rover->state().X_WR.translation();
    RunFor(*rover, kBraked, 2.0);
    return (rover->state().X_WR.translation() - from).norm();
  };
  EXPECT_LT(moved_m(0.5 * (friction + both)), 2e-3);
  EXPECT_GT(moved_m(both + math::DegToRad(2.0)), 0.05);
}

INSTANTIATE_TEST_SUITE_P(BothFidelities, StressLaw,
                         ::testing::Values(Fidelity::kMultibody, Fidelity::kQuasiStatic),
                         [](const auto& tested) {
                           return tested.param == Fidelity::kMultibody ? "Multibody"
                                                                       : "QuasiStatic";
                         });

}  // namespace
}  // namespace rockyard::rover
