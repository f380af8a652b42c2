// A rover is embedded when its own wheels stand deeper than their axles, in a whole drive.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "pathfinder_trials.h"

namespace rockyard::trial {
namespace {

// Whether a drive ends since soil in which a wheel of 6.5 cm under a sixth of the rover sinks by
// `sinkage_m` has swallowed the wheels. For n = 1, N = 2/3 b k sqrt(D) z^1.5.
bool IsSwallowed(double sinkage_m, double wheel_radius_m, const std::string& fidelity) {
  constexpr double kLoad_N = 20.0 * 9.81 / 6.0;
  const double modulus = 1.5 * kLoad_N / (0.08 * std::sqrt(2.0 * 0.065) * std::pow(sinkage_m, 1.5));
  const DriveResult result = RunTrial(
      Pathfinder("level_sand",
                 {"rover.fidelity=" + fidelity, "terrain.ground.soil.sinkage_exponent=1",
                  "terrain.ground.soil.cohesive_modulus_N_per_mn1=0",
                  "terrain.ground.soil.frictional_modulus_N_per_mn2=" + std::to_string(modulus),
                  "rover.geometry.wheel_radius_m=" + std::to_string(wheel_radius_m),
                  "referee.time_limit_s=30"}),
      {1, 0});
  return result.detail.find("sank into the soil") != std::string::npos;
}

// The limit is the radius of the wheels that the rover has. Smaller ones sink a little deeper in
// the same soil, as z grows with D^(-1/3), and reach their axles where those of 6.5 cm do not.
TEST(Embedded, FollowsTheRadiusOfTheRoversWheels) {
  for (const std::string fidelity : {"multibody", "quasi_static"}) {
    EXPECT_FALSE(IsSwallowed(0.059, 0.065, fidelity)) << fidelity;
    EXPECT_TRUE(IsSwallowed(0.071, 0.065, fidelity)) << fidelity;
    EXPECT_FALSE(IsSwallowed(0.047, 0.055, fidelity)) << fidelity;
    EXPECT_TRUE(IsSwallowed(0.059, 0.055, fidelity)) << fidelity;
  }
}

}  // namespace
}  // namespace rockyard::trial
