// What time step and solver sweeps do to the motion: not a matter of speed, but of counters.
// README.md of src/rover has the table; the first argument is the rate in Hz, the second the
// sweeps.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "rover_drive.h"
#include "stop_and_go.h"

namespace rockyard::rover {
namespace {

RoverParams ParamsOf(const benchmark::State& bench) {
  return RoverParams{.physics = {.step_s = 1.0 / static_cast<double>(bench.range(0)),
                                 .solver_iterations = bench.range(1)}};
}

// 14 s straight ahead over four rocks that lift one side at a time, by up to 9 cm.
void Rocks(benchmark::State& bench) {
  const RoverParams params = ParamsOf(bench);
  const terrain::Terrain terrain = FlatTerrain(
      {MakeRock(0.7, 0.2, 0.0, 0.12, 0.12, 0.05), MakeRock(1.1, -0.2, -0.02, 0.2, 0.15, 0.11),
       MakeRock(1.6, 0.18, -0.03, 0.15, 0.2, 0.10), MakeRock(2.1, 0.0, -0.05, 0.3, 0.5, 0.09)});
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  for (auto _ : bench) {
    const auto rover = PlacedRover(params, terrain);
    double tilt_rad = 0.0;
    for (int i = 0; i < static_cast<int>(std::lround(14.0 / rover->step_s())); ++i) {
      rover->Step(command);
      tilt_rad = std::max(tilt_rad, math::Tilt(rover->state().X_WR));
    }
    const math::Transform& X_WR = rover->state().X_WR;
    bench.counters["x_m"] = X_WR.translation().x();
    bench.counters["y_m"] = X_WR.translation().y();
    bench.counters["heading_deg"] = math::RadToDeg(math::Heading(X_WR));
    bench.counters["max_tilt_deg"] = math::RadToDeg(tilt_rad);
  }
}

// Slip in percent and load of the left front wheel, uphill at 15 deg.
void Slope(benchmark::State& bench) {
  const RoverParams params = ParamsOf(bench);
  const terrain::Terrain terrain = SlopeTerrain(math::DegToRad(15.0), 0.0);
  const messages::WheelCommand command = Drive(params, 0.15, 0.0);
  for (auto _ : bench) {
    const auto rover = PlacedRover(params, terrain);
    RunFor(*rover, command, 3.0);
    const math::Vector3 from = rover->state().X_WR.translation();
    RunFor(*rover, command, 4.0);
    const double moved_m = (rover->state().X_WR.translation() - from).norm();
    bench.counters["slip_percent"] = 100.0 * (1.0 - moved_m / 0.6);
    bench.counters["load_N"] = rover->state().wheel_load_N[0];
  }
}

// Legs of a trial on level sand: way over rim way, at ramps of 0, 0.1 and 0.2 s.
void StopAndGo(benchmark::State& bench) {
  const terrain::Terrain terrain = FlatTerrain();
  for (auto _ : bench) {
    for (const double ramp_s : {0.0, 0.1, 0.2}) {
      RoverParams params = ParamsOf(bench);
      params.drive.ramp_s = ramp_s;
      const double way = DriveLegs(params, terrain, 8).along;
      bench.counters["ramp_" + std::to_string(static_cast<int>(1000.0 * ramp_s)) + "_ms"] = way;
    }
  }
}

void Grid(benchmark::internal::Benchmark* b) {
  for (const int rate : {60, 120, 240, 480, 960}) b->Args({rate, 10});
  for (const int sweeps : {5, 20, 40}) b->Args({60, sweeps});
  b->Iterations(1)->Unit(benchmark::kMillisecond);
}
BENCHMARK(Rocks)->Apply(Grid);
BENCHMARK(Slope)->Apply(Grid);
BENCHMARK(StopAndGo)->Apply(Grid);

}  // namespace
}  // namespace rockyard::rover
