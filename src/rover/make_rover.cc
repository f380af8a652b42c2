// Makes the rover of the fidelity that the parameters name (rover.h).
#include "core/check.h"
#include "rover/multibody/rocker_bogie.h"
#include "rover/quasi_static/quasi_static_rover.h"
#include "rover/rover.h"

namespace rockyard::rover {

std::unique_ptr<Rover> MakeRover(const RoverParams& params, const terrain::Terrain& terrain) {
  if (params.fidelity == Fidelity::kQuasiStatic) {
    return std::make_unique<QuasiStaticRover>(params, terrain);
  }
  return std::make_unique<RockerBogie>(params, terrain);
}

std::unique_ptr<Rover> MakeRover(const RoverParams& params,
                                 const terrain::RockHoldingParams& holding,
                                 terrain::Terrain& terrain) {
  // RequireConsistency (trial/drive_checks_params.h) refuses movable rocks with another fidelity.
  EXPECT(params.fidelity == Fidelity::kMultibody);
  return std::make_unique<RockerBogie>(params, holding, terrain);
}

}  // namespace rockyard::rover
