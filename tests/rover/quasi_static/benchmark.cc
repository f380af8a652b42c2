// Time of the quasi-static rover: per step, per balance of forces, per trial of 135 s of motion,
// with a hash of the state at the end. Fields and pattern of motion as in rover_benchmark.cc.
#include <benchmark/benchmark.h>

#include <array>

#include "core/hash.h"
#include "fields.h"
#include "rover/quasi_static/quasi_static_rover.h"

namespace rockyard::rover {
namespace {

constexpr int kStepsPerTrial = 2700;

// Seven seconds ahead, one back, two turning; again and again.
const messages::WheelCommand& Pattern(int step,
                                      const std::array<messages::WheelCommand, 3>& commands) {
  const int second = step / 20 % 10;
  return commands[second < 7 ? 0 : second < 8 ? 1 : 2];
}

void Trial(benchmark::State& bench, double k, double pointedness = 0.0) {
  RoverParams params{.fidelity = Fidelity::kQuasiStatic};
  const terrain::Terrain terrain = ScatteredRocks(k, 1.0, 0, pointedness);
  const std::array<messages::WheelCommand, 3> commands{
      Drive(params, 0.15, 0.0), Drive(params, -0.15, 0.0), Drive(params, 0.0, 0.5)};
  std::string hash;
  double balances = 0.0;
  for (auto _ : bench) {
    QuasiStaticRover rover(params, terrain);
    rover.Place({});
    for (int i = 0; i < kStepsPerTrial; ++i) rover.Step(Pattern(i, commands));
    hash = StateHash(rover.state());
    balances = static_cast<double>(rover.work().balances);
  }
  using benchmark::Counter;
  bench.counters["trials"] = Counter(1.0, Counter::kIsIterationInvariantRate);
  bench.counters["step"] =
      Counter(kStepsPerTrial, Counter::kIsIterationInvariantRate | Counter::kInvert);
  bench.counters["balance"] =
      Counter(balances, Counter::kIsIterationInvariantRate | Counter::kInvert);
  bench.counters["balances_per_trial"] = balances;
  bench.SetLabel(hash);
}
BENCHMARK_CAPTURE(Trial, Level, 0.0)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Trial, Nominal, 0.00415)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Trial, VikingLander2, 0.013)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Trial, NominalPointed, 0.00415, 0.87)->Unit(benchmark::kMillisecond);

void Place(benchmark::State& bench) {
  RoverParams params{.fidelity = Fidelity::kQuasiStatic};
  const terrain::Terrain terrain = ScatteredRocks(0.013, 1.0, 0);
  QuasiStaticRover rover(params, terrain);
  for (auto _ : bench) {
    rover.Place({});
    benchmark::DoNotOptimize(rover.state().X_WR);
  }
}
BENCHMARK(Place)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace rockyard::rover
