// Time per physics step, with a hash of the final state.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "core/distributions.h"
#include "core/hash.h"
#include "core/random.h"
#include "rover_drive.h"

namespace rockyard::rover {
namespace {

std::string StateHash(const truth::RoverState& state) {
  core::Hasher hasher;
  for (int i = 0; i < 16; ++i) hasher.Real(state.X_WR.matrix().data()[i]);
  for (const double angle : state.wheel_angle_rad) hasher.Real(angle);
  return core::Hex(hasher.value());
}

void BM_Level(benchmark::State& bench) {
  const RoverParams params;
  const terrain::Terrain terrain = FlatTerrain();
  const auto rover = MakeRover(params, terrain);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  rover->Place({});
  for (auto _ : bench) rover->Step(command);
  rover->Place({});
  RunFor(*rover, command, 10.0);
  bench.SetLabel(StateHash(rover->state()));
}
BENCHMARK(BM_Level);

}  // namespace
}  // namespace rockyard::rover
