// Rovers of both fidelities on elevation models of a known ground.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "math/angles.h"
#include "rover_drive.h"
#include "terrain/analytic_ground.h"

namespace rockyard::rover {
namespace {

constexpr Fidelity kFidelities[] = {Fidelity::kMultibody, Fidelity::kQuasiStatic};

terrain::SoilParams Sand() { return BekkerSoil(terrain::SoilPreset::kLandscapingSand); }

truth::RoverState Driven(terrain::Terrain terrain, Fidelity fidelity, double time_s) {
  const RoverParams params = WithFidelity(fidelity);
  const RoverOn rover(std::move(terrain), params, {0.0, 0.2, 0.5});
  RunFor(*rover, Drive(params, 0.1, 0.05), time_s);
  return rover->state();
}

// Slip and tilt on a slope are those on the slope when it was sampled: planes are met exactly.
TEST(OnElevationModel, ASlopeIsDrivenAsThePlane) {
  const double slope = math::DegToRad(9.0);
  const double direction = 0.8;
  const auto height = [&](double x, double y) {
    return std::tan(slope) * (std::cos(direction) * x + std::sin(direction) * y);
  };
  for (const Fidelity fidelity : kFidelities) {
    const truth::RoverState plane = Driven(SlopeTerrain(slope, direction, Sand()), fidelity, 6.0);
    for (const double cell_m : {1.0, 0.25}) {
      const truth::RoverState model = Driven(
          {terrain::GroundOn(terrain::Sampled(height, cell_m), Sand()), {}, {}}, fidelity, 6.0);
      EXPECT_LT((model.X_WR.matrix() - plane.X_WR.matrix()).norm(), 1e-3) << cell_m;
    }
    // Slipping: the odometer's 0.6 m are not driven.
    EXPECT_LT(plane.X_WR.translation().norm(), 0.595);
    const truth::RoverState level = Driven(SlopeTerrain(0.0, 0.0, Sand()), fidelity, 6.0);
    EXPECT_GT((level.X_WR.matrix() - plane.X_WR.matrix()).norm(), 0.05) << "a control";
  }
}

// The stance on hills nears that on a fine model as fast as the heights do.
TEST(OnElevationModel, StancesOnHillsConverge) {
  for (const Fidelity fidelity : kFidelities) {
    const auto stance = [&](double cell_m, const math::Pose2& X_WR) {
      const RoverOn rover(
          terrain::Terrain(terrain::GroundOn(terrain::Sampled(terrain::Hills, cell_m), Sand()), {},
                           {}),
          WithFidelity(fidelity), X_WR);
      RunFor(*rover, kBraked, 0.2);
      return rover->state().X_WR.matrix().eval();
    };
    std::vector<double> errors(3);
    for (const math::Pose2 X_WR :
         {math::Pose2{0.3, 0.6, 0.2}, {2.1, -1.2, 1.4}, {3.4, 0.1, -2.0}}) {
      const auto fine = stance(1.0 / 32.0, X_WR);
      double cell_m = 1.0;
      for (double& error : errors) {
        error = std::max(error, (stance(cell_m, X_WR) - fine).norm());
        cell_m *= 0.5;
      }
    }
    EXPECT_GT(errors[0], 1e-3) << "a control: coarse models differ";
    EXPECT_GT(errors[0] / errors[1], 6.0);
    // Braked wheels of the multibody rover stay where friction holds them, up to some millimetres.
    if (fidelity == Fidelity::kQuasiStatic) {
      EXPECT_GT(errors[1] / errors[2], 6.0);
    }
  }
}

}  // namespace
}  // namespace rockyard::rover
